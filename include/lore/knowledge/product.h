#pragma once

#include <lore/knowledge/shaping.h>

#include <optional>
#include <span>
#include <vector>

namespace lore {

/// The value of the feature that each window matches, if one does.
using FoundValues = std::vector<std::optional<double>>;
FoundValues values_of(Shaper const&, std::span<Window const>);

/// What several knowledge bases say of the same windows together (paper, figure 6): per window the product of their
/// values, and 0 where some base does not find it. Precondition: at least one row, all of one length, as values_of
/// gives them.
std::vector<double> product_of(std::span<FoundValues const> values);

}   // namespace lore
