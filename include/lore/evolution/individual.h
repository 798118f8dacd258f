#pragma once

#include <lore/evaluation/evaluator.h>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

namespace lore {

/// Who an individual is: the generation of its birth and its place among those born then. No counter anywhere.
/// Ordered by birth.
struct IndividualId {
    std::uint32_t generation = 0;
    std::uint32_t slot = 0;
    friend auto operator<=>(IndividualId const&, IndividualId const&) = default;
};

/// An individual as its descendants remember it; shared by them, gone with the last of them.
struct Birth {
    IndividualId id;
    std::shared_ptr<Birth const> parent;   ///< null for founders
    Genome genome;
    int balls = 0;
    double shaping = no_feature_value;   ///< RS; by rule share, in the joint ranking of its generation of birth
    double diversity = 0;                ///< BD in the joint ranking of its generation of birth
    ~Birth();                            ///< releases a long lineage without recursion
};

/// Objectives, all maximized, in the order of the treatment (balls, diversity, shaping).
struct Objectives {
    std::array<double, 3> value{};
    int count = 0;
    friend bool operator==(Objectives const&, Objectives const&) = default;
};

struct Individual {
    std::shared_ptr<Birth const> birth;
    std::shared_ptr<Descriptors const> descriptors;
    /// Rule share alone: the features that it shows, each once, in increasing order; null by other rules.
    std::shared_ptr<std::vector<std::uint32_t> const> shown;
    double diversity = 0;                ///< BD as of the last joint ranking
    double shaping = no_feature_value;   ///< RS as of the last joint ranking
    Objectives objectives;               ///< as of the last joint ranking
    double crowding = 0;                 ///< as of the last joint ranking
    IndividualId id() const { return birth->id; }
};

struct Population {
    int generation = 0;
    std::vector<Individual> members;
    /// Of the members, by the distance that served last. May be empty (a checkpoint need not keep it): then it is
    /// measured anew, with the same result.
    DistanceMatrix distances;
    DistanceKind distance_kind = DistanceKind::adhoc;
};

}   // namespace lore
