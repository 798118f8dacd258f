#pragma once

#include "byte_stream.h"

#include <lore/network/genome.h>

namespace lore {

/// A child as its difference from its parent. Mutation keeps the order of the edges, removes some, changes some in
/// place and appends new ones; where that does not tell the whole story (a deleted neuron renumbers the others) the
/// child is written out. Both have one interface; a founder's parent is a genome without edges and biases.
void put_difference(ByteWriter&, Genome const& parent, Genome const& child);
/// Checks the result: throws Error where it is no valid genome.
Genome get_difference(ByteReader&, Genome const& parent);

}   // namespace lore
