// The shortest tree of edges that joins four points, for determinants of their differences.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace stereodel::predicates {

class SpanningEdges {
  public:
    static constexpr std::size_t PAIRS = 6;

    struct Edge {
        std::size_t from, to, pair;  // points 0 .. 3; which pair it is
    };

    // length(pair, from, to), any integer that grows with the length. Pairs are 01, 02, 03, 12, 13, 23.
    template <class Length>
    explicit SpanningEdges(Length&& length) {
        std::array<int, PAIRS> lengths{};
        for (std::size_t pair = 0; pair < PAIRS; ++pair) {
            lengths[pair] = length(pair, FROM[pair], TO[pair]);
        }
        std::array<std::size_t, PAIRS> order = {0, 1, 2, 3, 4, 5};
        for (std::size_t k = 1; k < PAIRS; ++k) {
            for (std::size_t j = k; j > 0 && lengths[order[j]] < lengths[order[j - 1]]; --j) {
                std::swap(order[j], order[j - 1]);
            }
        }
        std::array<std::size_t, 4> part = {0, 1, 2, 3};
        std::size_t count = 0;
        for (const std::size_t pair : order) {
            const std::size_t old = part[TO[pair]], common = part[FROM[pair]];
            if (old != common) {
                edges_[count++] = {FROM[pair], TO[pair], pair};
                for (std::size_t& number : part) {
                    number = number == old ? common : number;
                }
            }
        }
    }

    // The shortest first.
    const Edge& operator[](std::size_t k) const { return edges_[k]; }

    // An end of the shortest edge, that which the next edge has too if there is one.
    std::size_t root() const {
        const auto ends = [](const Edge& edge, std::size_t point) { return edge.from == point || edge.to == point; };
        const std::size_t from = edges_[0].from, to = edges_[0].to;
        return ends(edges_[1], to) || (!ends(edges_[1], from) && ends(edges_[2], to)) ? to : from;
    }

    // The sign that turns det[edge 0, edge 1, edge 2] into det[1 - 0, 2 - 0, 3 - 0].
    int orientation() const {
        std::array<std::array<int, 3>, 3> m{};  // the edges in terms of the differences from point 0
        for (std::size_t k = 0; k < 3; ++k) {
            m[k][edges_[k].to - 1] = 1;  // `to` is never 0
            if (edges_[k].from > 0) {
                m[k][edges_[k].from - 1] = -1;
            }
        }
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }

  private:
    static constexpr std::array<std::size_t, PAIRS> FROM = {0, 0, 0, 1, 1, 2}, TO = {1, 2, 3, 2, 3, 3};

    std::array<Edge, 3> edges_{};
};

}  // namespace stereodel::predicates
