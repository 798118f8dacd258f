#include <lore/evolution/individual.h>

#include <utility>

namespace lore {

Birth::~Birth() {
    // Releases, one after the other, the ancestors that only this lineage holds. Otherwise each would be released from
    // within its child's destructor, thousands deep.
    std::shared_ptr<Birth const> ancestor = std::move(parent);
    // No other pointer holds this ancestor, so no reader sees its parent taken away. Births are made non-const (breed,
    // the archive).
    while (ancestor && ancestor.use_count() == 1) ancestor = std::move(const_cast<Birth&>(*ancestor).parent);
}

}   // namespace lore
