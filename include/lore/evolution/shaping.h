#pragma once

#include <lore/evolution/individual.h>
#include <lore/knowledge/shaping.h>

#include <span>
#include <string_view>
#include <vector>

namespace lore {

/// What evolution does with RS.
enum class ShapingUse : std::uint8_t {
    objective,   ///< one more objective (paper, "Knowledge exploitation")
    distance,    ///< one of the dynamic distances: in the periods that draw it, RS is an objective in place of BD
    ties         ///< an order among equals, before the tie rule: wherever a sort or a cut meets equals, larger RS first
};
std::string_view name(ShapingUse);
ShapingUse shaping_use(std::string_view name);   ///< throws UsageError

/// How a run uses its knowledge base.
struct ShapingConfig {
    ShapingRule rule = ShapingRule::max;
    ShapingUse use = ShapingUse::objective;
};

/// RS by rule share for every member of a pool: the sum over the features b that x shows, in increasing order, of
/// v_b (1 - n_b / N), with n_b of the N members showing b. `values`: v_b of every feature of the base.
std::vector<double> shares(std::span<Individual const> pool, std::span<double const> values);

}   // namespace lore
