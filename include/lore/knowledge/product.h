#pragma once

#include <lore/knowledge/shaping.h>

#include <span>
#include <vector>

namespace lore {

/// The value of the feature that each window matches; no_feature_value where none does.
std::vector<double> values_of(Shaper const&, std::span<Window const>);

/// What several knowledge bases say of the same windows together (paper, figure 6): per window the product of their
/// values, and 0 where some base does not find it. Precondition: at least one row, all of one length, as values_of
/// gives them.
std::vector<double> product_of(std::span<std::vector<double> const> values);

}   // namespace lore
