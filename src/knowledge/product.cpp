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
    for (std::size_t w = 0; w < product.size(); ++w)
        for (FoundValues const& factors : values) {
            assert(factors.size() == product.size());
            if (!factors[w]) {
                product[w] = 0;   // not times 0: that makes -0 of a negative product, and NaN of an infinite one
                break;
            }
            product[w] *= *factors[w];
        }
    return product;
}

}   // namespace lore
