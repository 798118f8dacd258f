#pragma once

#include "support/pointers.h"

#include <lore/core/isa.h>
#include <lore/evaluation/evaluation.h>
#include <lore/knowledge/builder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace lore::test {

inline std::vector<Isa> usable_isas() {
    std::vector<Isa> isas;
    for (Isa isa : {Isa::baseline, Isa::v3, Isa::v4})
        if (isa <= detected_isa()) isas.push_back(isa);
    return isas;
}

inline std::vector<Evaluation> evaluate_all_plainly(EvaluationContext const& context,
                                                    std::vector<Genome> const& genomes) {
    std::vector<Evaluation> evaluations;
    for (Genome const& genome : genomes) evaluations.push_back(evaluate_plainly(context, genome));
    return evaluations;
}

inline void expect_equal(Evaluation const& fast, Evaluation const& plain) {
    EXPECT_EQ(fast.reward, plain.reward);
    EXPECT_EQ(fast.shaping, plain.shaping);
    EXPECT_EQ(fast.descriptors.outcome, plain.descriptors.outcome);
    EXPECT_EQ(fast.descriptors.path, plain.descriptors.path);
    EXPECT_EQ(fast.descriptors.entropies, plain.descriptors.entropies);
    auto const difference = std::mismatch(fast.descriptors.channel_bits.begin(), fast.descriptors.channel_bits.end(),
                                          plain.descriptors.channel_bits.begin(), plain.descriptors.channel_bits.end());
    EXPECT_EQ(fast.descriptors.channel_bits.size(), plain.descriptors.channel_bits.size());
    EXPECT_TRUE(difference.first == fast.descriptors.channel_bits.end())
        << "first in word " << difference.first - fast.descriptors.channel_bits.begin();
    EXPECT_TRUE(fast == plain);
}

/// With every instruction set this processor has, against evaluations done plainly.
inline void expect_batches_equal(EvaluationContext const& context, std::vector<Genome> const& genomes,
                                 std::vector<Evaluation> const& plain) {
    Isa const before = active_isa();
    for (Isa isa : usable_isas()) {
        use_isa(isa);
        auto const fast = evaluate_batch(context, pointers_to(genomes));
        ASSERT_EQ(fast.size(), plain.size());
        for (std::size_t i = 0; i < fast.size(); ++i) {
            SCOPED_TRACE("individual " + std::to_string(i) + ", " + std::string{name(isa)});
            expect_equal(fast[i], plain[i]);
            if (testing::Test::HasFailure()) break;
        }
        if (testing::Test::HasFailure()) break;
    }
    use_isa(before);
}

/// A knowledge base of what these individuals do in 1000 steps. Their rewards, which are often the same, are made to
/// differ.
inline Shaper shaper_of(World const& world, std::vector<Genome> const& teachers, KnowledgeConfig config,
                        ShapingRule rule = ShapingRule::max) {
    config.channels = Channels{world.facts()};
    KnowledgeBuilder builder{config, make_exact_index(config)};
    for (std::size_t i = 0; i < teachers.size(); ++i) {
        Trace const trace = record_episode(world, compile(teachers[i]), {1000});
        builder.add_individual({windows_of(trace, config.window_length), trace.reward + static_cast<double>(i % 7)});
    }
    return Shaper{std::move(builder).finish({}), rule};
}

}   // namespace lore::test
