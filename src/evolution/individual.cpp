#include <lore/evolution/individual.h>

#include <utility>

namespace lore {

Birth::~Birth() {
    // Ancestors that only this lineage still remembers go one after the other; left to itself, each would be released
    // from within its child's destructor, thousands deep.
    std::shared_ptr<Birth const> ancestor = std::move(parent);
    // Nobody else holds it, so nobody sees its parent taken away; births are made non-const (breed, the archive).
    while (ancestor && ancestor.use_count() == 1) ancestor = std::move(const_cast<Birth&>(*ancestor).parent);
}

}   // namespace lore
