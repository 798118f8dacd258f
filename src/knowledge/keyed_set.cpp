#include "keyed_set.h"
#include "exact_shape.h"

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

KeyedSet::KeyedSet(Shape const& shape) : shape_(&shape), patterns_(pattern_room(shape.words)) {
    auto const masks = growing_masks_of(shape);
    for (auto mask = masks.begin(); tables_.size() < static_cast<std::size_t>(growing_tables(shape));
         mask += shape.words)
        tables_.emplace_back(std::vector(mask, mask + shape.words));
    for (GrowingTable const& table : tables_) views_.push_back(table.view());
}

void KeyedSet::add(Question const& one) {
    std::size_t const number = size();
    keep(one);
    for (std::size_t table = 0; table < tables_.size(); ++table) fill(table, number, {&one, 1});
}

void KeyedSet::add(std::span<Question const> described, Crew& crew, std::function<void()> const& beside) {
    std::size_t const first = size();
    for (Question const& one : described) keep(one);
    crew.share(tables_.size() + 1, 1, [&](std::size_t, std::size_t item, std::size_t) {
        if (item == 0) beside();
        else fill(item - 1, first, described);
    });
}

void KeyedSet::clear() {
    patterns_.clear();
    codes_.resize(0);
    for (std::size_t table = 0; table < tables_.size(); ++table) {
        tables_[table].clear();
        views_[table] = tables_[table].view();
    }
}

/// All but its key.
void KeyedSet::keep(Question const& described) {
    std::size_t const bytes = static_cast<std::size_t>(shape_->code_size);
    std::copy_n(described.words, shape_->words, patterns_.add());
    codes_.resize(patterns_.count() * bytes);
    std::copy_n(described.codes, bytes, codes_.data() + codes_.size() - bytes);
}

/// With features from number `first` on.
void KeyedSet::fill(std::size_t table, std::size_t first, std::span<Question const> described) {
    for (Question const& one : described) {
        Key key = one.key;
        key.feature = static_cast<std::int32_t>(first++);
        tables_[table].add(patterns_, key);
    }
    views_[table] = tables_[table].view();
}

std::size_t KeyedSet::largest_bucket() const {
    std::size_t largest = 0;
    for (GrowingTable const& table : tables_) largest = std::max(largest, table.largest_bucket());
    return largest;
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
