#pragma once

#include <vector>

namespace lore::test {

/// A pointer to each item, as requests and pools take them. Valid as long as the vector stays as it is.
template <class Item>
std::vector<Item const*> pointers_to(std::vector<Item> const& items) {
    std::vector<Item const*> pointers;
    for (Item const& item : items) pointers.push_back(&item);
    return pointers;
}

}   // namespace lore::test
