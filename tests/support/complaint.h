#pragma once

#include <lore/core/error.h>

#include <string>

namespace lore::test {

/// What the error of this kind says that the call throws; "" if it throws none. Others pass.
template <class Kind = Error, class Call>
std::string complaint_of(Call const& call) {
    try {
        call();
    } catch (Kind const& error) { return error.what(); }
    return "";
}

}   // namespace lore::test
