#include "genome_difference.h"

#include "edge_bytes.h"

namespace lore {

namespace {

enum Form : std::uint8_t { written_out = 0, changed = 1 };

bool same_ends(Edge const& a, Edge const& b) { return a.source == b.source && a.target == b.target; }

void put_edge(ByteWriter& out, Edge const& edge) { out.put(EdgeBytes{edge}); }
Edge get_edge(ByteReader& in) { return in.get<EdgeBytes>().edge(); }

/// Places in the parent's list: which edges go, which change, and how many of the child's are new at its end.
struct Alignment {
    std::vector<std::size_t> removed, reweighted, rewired;
    std::size_t appended_from = 0;   ///< index into the child's edges
};

/// Walks both lists. The parent's edge is gone if the child's present one is the parent's next; it is rewired if the
/// two that follow are equal again, or the lists end here.
Alignment align(std::vector<Edge> const& parent, std::vector<Edge> const& child) {
    Alignment found;
    std::size_t j = 0;
    for (std::size_t i = 0; i < parent.size(); ++i) {
        if (j < child.size() && same_ends(parent[i], child[j])) {
            if (parent[i].weight != child[j].weight) found.reweighted.push_back(i);
            ++j;
        } else if (j < child.size() && (i + 1 == parent.size() || !same_ends(parent[i + 1], child[j]))) {
            found.rewired.push_back(i);
            ++j;
        } else {
            found.removed.push_back(i);
        }
    }
    found.appended_from = j;
    return found;
}

/// Increasing places as gaps, most of them a byte.
class Places {
public:
    std::size_t gap(std::size_t place) {
        std::size_t const step = place - next_;
        next_ = place + 1;
        return step;
    }
    std::size_t place(std::size_t gap) {
        std::size_t const at = next_ + gap;
        next_ = at + 1;
        return at;
    }

private:
    std::size_t next_ = 0;
};

void put_changes(ByteWriter& out, Genome const& parent, Genome const& child) {
    Alignment const found = align(parent.edges, child.edges);
    auto const place_in_child = [&](std::size_t i) {
        std::size_t gone = 0;
        while (gone < found.removed.size() && found.removed[gone] < i) ++gone;
        return i - gone;
    };
    auto const put_places = [&](std::vector<std::size_t> const& places, auto const& put_value) {
        out.put_varint(places.size());
        Places gaps;
        for (std::size_t const i : places) {
            out.put_varint(gaps.gap(i));
            put_value(i);
        }
    };
    put_places(found.removed, [](std::size_t) {});
    put_places(found.reweighted, [&](std::size_t i) { out.put(child.edges[place_in_child(i)].weight); });
    put_places(found.rewired, [&](std::size_t i) { put_edge(out, child.edges[place_in_child(i)]); });
    out.put_varint(child.edges.size() - found.appended_from);
    for (std::size_t j = found.appended_from; j < child.edges.size(); ++j) put_edge(out, child.edges[j]);

    std::vector<std::size_t> changed_biases;
    std::size_t const common = std::min(parent.biases.size(), child.biases.size());
    for (std::size_t i = 0; i < common; ++i)
        if (parent.biases[i] != child.biases[i]) changed_biases.push_back(i);
    out.put_varint(child.biases.size());
    put_places(changed_biases, [&](std::size_t i) { out.put(child.biases[i]); });
    out.put_all(std::span{child.biases}.subspan(common));
}

Genome get_changes(ByteReader& in, Genome const& parent) {
    Genome child = parent;
    std::vector<bool> gone(parent.edges.size(), false);
    auto const get_places = [&](std::size_t size, auto const& get_value) {
        Places gaps;
        for (std::size_t count = in.get_count(size); count > 0; --count) {
            std::size_t const at = gaps.place(in.get_count(size));
            if (at >= size) in.fail("a place is out of range");
            get_value(at);
        }
    };
    get_places(parent.edges.size(), [&](std::size_t at) { gone[at] = true; });
    get_places(parent.edges.size(), [&](std::size_t at) { child.edges[at].weight = in.get<float>(); });
    get_places(parent.edges.size(), [&](std::size_t at) { child.edges[at] = get_edge(in); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < parent.edges.size(); ++i)
        if (!gone[i]) child.edges[kept++] = child.edges[i];
    child.edges.resize(kept);
    for (std::size_t count = in.get_count(most_edges); count > 0; --count) child.edges.push_back(get_edge(in));

    std::size_t const biases = in.get_count(parent.interface.outputs + std::size_t{most_hidden});
    std::size_t const common = std::min(parent.biases.size(), biases);
    child.biases.resize(biases);
    get_places(common, [&](std::size_t at) { child.biases[at] = in.get<float>(); });
    for (std::size_t i = common; i < biases; ++i) child.biases[i] = in.get<float>();
    return child;
}

}   // namespace

void put_difference(ByteWriter& out, Genome const& parent, Genome const& child) {
    ByteWriter changes;
    put_changes(changes, parent, child);
    Bytes const bytes = changes.take();
    if (ByteReader in{bytes, "a difference"}; get_changes(in, parent) == child) {
        std::size_t const whole = child.edges.size() * sizeof(EdgeBytes) + child.biases.size() * sizeof(float);
        if (bytes.size() < whole) {
            out.put(changed);
            out.put_all(std::span{bytes});
            return;
        }
    }
    out.put(written_out);
    out.put_varint(child.edges.size());
    for (Edge const& edge : child.edges) put_edge(out, edge);
    out.put_varint(child.biases.size());
    out.put_all(std::span{child.biases});
}

Genome get_difference(ByteReader& in, Genome const& parent) {
    Genome child{parent.interface};
    switch (in.get<std::uint8_t>()) {
    case changed: child = get_changes(in, parent); break;
    case written_out:
        for (std::size_t count = in.get_count(most_edges); count > 0; --count) child.edges.push_back(get_edge(in));
        child.biases = in.get_all<float>(in.get_count(child.interface.outputs + std::size_t{most_hidden}));
        break;
    default: in.fail("a form that is not known");
    }
    if (std::string const why = why_invalid(child); !why.empty()) in.fail("an invalid genome: " + why);
    return child;
}

}   // namespace lore
