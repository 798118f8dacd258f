#include <lore/evaluation/evaluation_queue.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace lore {

namespace {

bool larger(Genome const& a, Genome const& b) {
    return a.biases.size() != b.biases.size() ? a.biases.size() > b.biases.size() : a.edges.size() > b.edges.size();
}

}   // namespace

Request::Request(std::span<Genome const* const> genomes)
    : genomes_(genomes), order_(genomes.size()), evaluations_(genomes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) {
        return larger(*genomes_[static_cast<std::size_t>(a)], *genomes_[static_cast<std::size_t>(b)]);
    });
}

Evaluation const& Request::deliver(int ticket, Evaluation evaluation) {
    assert(0 <= ticket && ticket < next_);
    ++done_;
    return evaluations_[static_cast<std::size_t>(index(ticket))] = std::move(evaluation);
}

std::vector<Evaluation> Request::results() && {
    assert(complete());
    return std::move(evaluations_);
}

}   // namespace lore
