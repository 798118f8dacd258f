#include <lore/knowledge/product.h>

#include <cassert>

namespace lore {

std::vector<double> values_of(Shaper const& shaper, std::span<Window const> windows) {
    auto reader = shaper.reader();
    std::vector<double> values;
    values.reserve(windows.size());
    for (Window const& window : windows) {
        Match const match = reader.match(window);
        values.push_back(match.found() ? shaper.base().value(match.feature) : no_feature_value);
    }
    return values;
}

std::vector<double> product_of(std::span<std::vector<double> const> values) {
    assert(!values.empty());
    std::vector<double> product(values.front().size(), 1.0);
    for (std::vector<double> const& factors : values) {
        assert(factors.size() == product.size());
        for (std::size_t w = 0; w < product.size(); ++w)
            product[w] *= factors[w] == no_feature_value ? 0.0 : factors[w];
    }
    return product;
}

}   // namespace lore
