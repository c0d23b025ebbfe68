#include "graphs/spanning_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "graphs/sites.hpp"

namespace stereodel::graphs {
namespace {

// Disjoint sets of points; paths are halved on the way.
class Components {
  public:
    explicit Components(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

    // Whether two points were in different sets, which are one from now on.
    bool join(Index a, Index b) {
        const Index u = root(a), v = root(b);
        parent(std::max(u, v)) = std::min(u, v);
        return u != v;
    }

  private:
    Index& parent(Index a) { return parent_[static_cast<std::size_t>(a)]; }

    Index root(Index a) {
        while (parent(a) != a) {
            parent(a) = parent(parent(a));
            a = parent(a);
        }
        return a;
    }

    std::vector<Index> parent_;
};

struct TreeEdge {
    double square;
    Index a, b;
};

// Whether the ends of one edge come before those of another.
template <class Sites>
bool ends_before(const Sites& sites, const TreeEdge& e, const TreeEdge& f) {
    const auto ends = [&](const TreeEdge& g) {
        return sites.compare(g.a, g.b) < 0 ? std::pair(g.a, g.b) : std::pair(g.b, g.a);
    };
    const auto [low, high] = ends(e);
    const auto [other_low, other_high] = ends(f);
    const int sign = low == other_low ? 0 : sites.compare(low, other_low);
    return sign != 0 ? sign < 0 : high != other_high && sites.compare(high, other_high) < 0;
}

template <class Sites>
bool is_before(const Sites& sites, const TreeEdge& e, const TreeEdge& f) {
    Sign sign = sites.compare_squares(e.square, f.square);
    if (sign == OPEN) {
        sign = sites.compare_lengths(e.a, e.b, f.a, f.b);
    }
    return sign != 0 ? sign < 0 : ends_before(sites, e, f);
}

}  // namespace

template <std::size_t Width>
Pairs spanning_tree(const double* points, std::size_t size, const Pairs& edges, Stop stop) {
    const SitesOf<Width> sites(points, size);
    std::vector<TreeEdge> sorted;
    sorted.reserve(edges.size());
    for (const auto& [a, b] : edges) {
        sorted.push_back({sites.square(a, b), std::min(a, b), std::max(a, b)});
    }
    std::sort(sorted.begin(), sorted.end(), [&](const TreeEdge& e, const TreeEdge& f) {
        check(stop);
        return is_before(sites, e, f);
    });
    Components components(size);
    Pairs tree;
    for (const TreeEdge& edge : sorted) {
        if (components.join(edge.a, edge.b)) {
            tree.emplace_back(edge.a, edge.b);
        }
    }
    std::sort(tree.begin(), tree.end());
    return tree;
}

template Pairs spanning_tree<2>(const double*, std::size_t, const Pairs&, Stop);
template Pairs spanning_tree<3>(const double*, std::size_t, const Pairs&, Stop);

}  // namespace stereodel::graphs
