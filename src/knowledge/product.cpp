#include <lore/knowledge/product.h>

#include <cassert>

namespace lore {

FoundValues values_of(Shaper const& shaper, std::span<Window const> windows) {
    auto reader = shaper.reader();
    FoundValues values;
    values.reserve(windows.size());
    for (Window const& window : windows) {
        Match const match = reader.match(window);
        values.push_back(match.found() ? std::optional{shaper.base().value(match.feature)} : std::nullopt);
    }
    return values;
}

std::vector<double> product_of(std::span<FoundValues const> values) {
    assert(!values.empty());
    std::vector<double> product(values.front().size(), 1.0);
    for (FoundValues const& factors : values) {
        assert(factors.size() == product.size());
        for (std::size_t w = 0; w < product.size(); ++w) product[w] *= factors[w].value_or(0.0);
    }
    return product;
}

}   // namespace lore
