#pragma once

#include <lore/network/genome.h>

namespace lore::test {

/// The interface of collectball's robot: inputs 0 to 11, outputs 12 to 14, hidden neurons from 15 on.
inline constexpr Interface robot{12, 3};

}   // namespace lore::test
