#pragma once

#include <lore/network/genome.h>

namespace lore {

/// Probabilities of the mutation operators (paper, appendix; eta from the published experiment code).
struct MutationConfig {
    double weight_probability = 0.10;   ///< per weight gene: polynomial mutation
    double bias_probability = 0.10;     ///< per bias gene: polynomial mutation
    double rewire_probability = 0.03;   ///< per edge, at most one edge a mutation
    double add_edge_probability = 0.15;
    double delete_edge_probability = 0.05;
    double add_neuron_probability = 0.05;   ///< splits an edge
    double delete_neuron_probability = 0.05;
    int eta = 15;   ///< distribution index of the polynomial mutation; 2^k - 1
};

/// Mutates in place, operators in the order of the declarations below (experiment: section 5).
void mutate(Genome&, MutationConfig const&, NetworkLimits const&, Stream& rng);

/// Polynomial mutation of one gene (Deb 2001) from one uniform draw: u < 0.5: d = (2u)^(1/(eta+1)) - 1, else
/// d = 1 - (2(1-u))^(1/(eta+1)); clamped to [0, 1]. eta + 1 is a power of two, so that the root is a chain of square
/// roots and the same to the bit with any C library.
float polynomial_mutation(float gene, int eta, double u);

void mutate_weights(Genome&, MutationConfig const&, Stream& rng);
void rewire(Genome&, MutationConfig const&, Stream& rng);
void mutate_biases(Genome&, MutationConfig const&, Stream& rng);
/// Returns false where the limit, or the lack of a free pair of neurons, forbids it; likewise below.
bool add_edge(Genome&, NetworkLimits const&, Stream& rng);
bool delete_edge(Genome&, Stream& rng);
bool split_edge(Genome&, NetworkLimits const&, Stream& rng);
bool delete_neuron(Genome&, Stream& rng);

}   // namespace lore
