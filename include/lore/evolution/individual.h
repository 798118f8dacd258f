#pragma once

#include <lore/behavior/distance_matrix.h>
#include <lore/evaluation/evaluation.h>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

namespace lore {

/// An individual's name: the generation of its birth and its place among the individuals born then. Ordered by birth.
struct IndividualId {
    std::uint32_t generation = 0;
    std::uint32_t slot = 0;
    friend auto operator<=>(IndividualId const&, IndividualId const&) = default;
};

/// What remains of an individual for its lineage; shared by its descendants and released with the last of them.
struct Birth {
    IndividualId id;
    std::shared_ptr<Birth const> parent;   ///< null for founders
    Genome genome;
    double reward = 0;                   ///< Evaluation::reward
    double shaping = no_feature_value;   ///< RS; by rule share, in the joint ranking of the generation it was born in
    double diversity = 0;                ///< BD in the joint ranking of the generation it was born in
    ~Birth();                            ///< releases a long lineage without recursion
};

/// The first `count` values (1 to 3, finite) are objectives, all maximized, in the order of the treatment (reward,
/// diversity, shaping); the others are 0.
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
    /// Of the members, by distance_kind. Empty by a Euclidean kind, which is measured anew every generation. May always
    /// be empty, since a checkpoint need not keep it: evolve then measures it again, with the same result.
    DistanceMatrix distances;
    DistanceKind distance_kind = DistanceKind::adhoc;
};

}   // namespace lore
