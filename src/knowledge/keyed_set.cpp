#include "keyed_set.h"

#include <algorithm>

namespace lore::exact {

void Descriptions::resize(std::size_t windows) {
    if (windows <= keys_.size()) return;
    patterns_.resize(windows * static_cast<std::size_t>(shape_->words));
    codes_.resize(windows * static_cast<std::size_t>(shape_->code_size));
    keys_.resize(windows);
}

void Descriptions::describe(std::size_t number, Kernel const& kernel, Window const& window) {
    keys_[number] = kernel.describe(*shape_, window.bits.data(), window.values.data(),
                                    patterns_.data() + number * static_cast<std::size_t>(shape_->words),
                                    codes_.data() + number * static_cast<std::size_t>(shape_->code_size));
}

Question Descriptions::operator[](std::size_t number) const {
    return {patterns_.data() + number * static_cast<std::size_t>(shape_->words),
            codes_.data() + number * static_cast<std::size_t>(shape_->code_size), keys_[number]};
}

void KeyedSet::add(Question const& described) {
    std::copy_n(described.words, patterns_.record_words(), patterns_.add());
    auto const bytes = static_cast<std::size_t>(shape_->code_size);
    codes_.resize(patterns_.count() * bytes);
    std::copy_n(described.codes, bytes, codes_.data() + codes_.size() - bytes);
    tables_.add(patterns_, described.key);
}

Scratch SearchMemory::room_for(Shape const& shape, std::size_t largest_bucket, RecentMatches* recent) {
    auto const tables = static_cast<std::size_t>(growing_tables(shape));
    visits_.resize(tables);
    if (std::size_t const room = largest_bucket + spare_keys; features_.size() < room) {
        features_.resize(room * 2);
        apart_.resize(room * 2);
        groups_.resize(room * 2 / key_group + 1 + spare_keys);
        promising_.resize(room * 2);
        finalists_.resize(room * 2 * tables + 1);
    }
    return {visits_.data(),
            features_.data(),
            apart_.data(),
            groups_.data(),
            recent == nullptr ? nullptr : recent->data(),
            &last_,
            promising_.data(),
            finalists_.data()};
}

}   // namespace lore::exact
