#include "interpolation/natural_neighbors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "interpolation/stolen_areas.hpp"
#include "mesh/walk.hpp"
#include "queries/query_pieces.hpp"

namespace stereodel::interpolation {

using mesh::WalkEnd;
using mesh::place_opposite;
using mesh::walk;
using queries::first_open;
using queries::for_queries;

namespace {

constexpr double UNKNOWN = std::numeric_limits<double>::quiet_NaN();

// What a point counts for: an area, its part of all areas, and its derivative by the place of the query.
struct Share {
    Index point;
    double area;
    Local slope;
    double weight = 0.0;
};

// One thread's work.
template <class Query, class Around>
class Interpolation {
  public:
    static constexpr std::size_t dimension = Query::Chart::dimension;

    Interpolation(const NaturalNeighborTask& task, Stop stop)
        : task_(task),
          triangles_(task.triangles),
          query_(triangles_.points()),
          around_(task.units != nullptr ? task.units : triangles_.points(), task.unit_rests),
          stop_(stop) {}

    void operator()(std::size_t k, const double* query, Index& near) {
        query_.take(query);
        const WalkEnd end = walk(triangles_, near, [this](Index u, Index v) { return query_.side(u, v); }, stop_);
        near = end.triangle;
        shares_.clear();
        has_slopes_ = true;
        if (end.exit < 0) {
            around_.take(sphere() ? task_.query_units + 3 * k : query, sphere() ? task_.query_rests + 3 * k : nullptr);
            find_shares(end);
            weigh();
        }
        if (task_.counts != nullptr) {
            task_.counts[k] = static_cast<std::int64_t>(shares_.size());
        } else if (task_.weights != nullptr) {
            put_weights(static_cast<std::size_t>(task_.starts[k]));
        } else {
            put(k);
        }
    }

  private:
    // The edge u -> v of a triangle that goes, that triangle's centre, and the triangle across.
    struct Edge {
        Index u, v, across;
        Local inner;
    };

    bool sphere() const { return task_.units != nullptr; }

    void find_shares(const WalkEnd& end) {
        const Index* const c = triangles_.corners(end.triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            if (end.side[(k + 1) % 3] == 0 && end.side[(k + 2) % 3] == 0) {
                has_slopes_ = false;
                shares_.push_back({c[k], 1.0, {}});
                total_ = 1.0;
                return;
            }
        }
        const std::size_t on = end.side[0] == 0 ? 0 : end.side[1] == 0 ? 1 : 2;
        const Index across = end.on_line() ? triangles_.neighbors(end.triangle)[on] : end.triangle;
        // The query does not see a closing triangle across: that is on the near side of the centre.
        const Index first = triangles_.may_enter(across) ? lower(across, end.triangle) : end.triangle;
        around_.fit(farthest(first));
        if (across >= 0) {
            take_conflicts(first);
            add_up();
        }
        if (across < 0 || !(total_ > 0.0) || !std::isfinite(total_)) {
            take_triangle(end.triangle);
        }
    }

    // By the corners, not by the number of a triangle: among some of the points, sums are rounded as among all.
    Index lower(Index s, Index t) const {
        const Index *const c = triangles_.corners(s), *const d = triangles_.corners(t);
        return std::lexicographical_compare(c, c + 3, d, d + 3) ? s : t;
    }

    Index farthest(Index t) const {
        const auto squared = [this](Index a) {
            const Local d = around_.at(a);
            return std::max(std::fabs(d.x), std::fabs(d.y));
        };
        const Index* const c = triangles_.corners(t);
        const Index a = squared(c[0]) < squared(c[1]) ? c[1] : c[0];
        return squared(a) < squared(c[2]) ? c[2] : a;
    }

    // The boundary of each cell's stolen part, edge by edge. The part of v between horizon edges u -> v and v -> w goes
    // counterclockwise along the new edge between the centres of u v q and v w q, then through the centres of the
    // triangles that go, around v. The triangles' dual graph is a tree, so none is reached twice.
    void take_conflicts(Index first) {
        const Index* const c = triangles_.corners(first);
        const Local center = center_of(first);
        front_.clear();
        rim_.clear();
        for (std::size_t k = 3; k-- > 0;) {
            front_.push_back({c[k], c[(k + 1) % 3], triangles_.neighbors(first)[(k + 2) % 3], center});
        }
        while (!front_.empty()) {
            const Edge edge = front_.back();
            front_.pop_back();
            if (edge.across < 0 || !query_.sees(triangles_.corners(edge.across))) {
                rim_.push_back(edge);
                continue;
            }
            const Index* const corners = triangles_.corners(edge.across);
            const Index* const across = triangles_.neighbors(edge.across);
            const std::size_t k = place_opposite(corners, edge.u, edge.v);
            const Local next = center_of(edge.across);
            add(edge.u, Around::sector(next, edge.inner));
            add(edge.v, Around::sector(edge.inner, next));
            front_.push_back({corners[k], edge.v, across[(k + 2) % 3], next});
            front_.push_back({edge.u, corners[k], across[(k + 1) % 3], next});
        }
        close_rim();
    }

    void close_rim() {
        const Local query{};
        const auto new_center = [&](const Edge& e) { return Around::center(query, around_.at(e.u), around_.at(e.v)); };
        Local before = new_center(rim_.back());
        for (const Edge& edge : rim_) {  // `before` belongs to the edge that ends in edge.u
            check(stop_);
            const Local here = new_center(edge), point = around_.at(edge.u);
            const Local moment = Around::moment(before, here);
            const double distance = std::sqrt(inner(point, point));
            shares_.push_back(
                {edge.u, Around::sector(before, here), {moment.x / distance, moment.y / distance, 0.0}});
            add(edge.u, Around::sector(here, edge.inner));
            add(edge.v, Around::sector(edge.inner, here));
            before = here;
        }
    }

    Local center_of(Index t) const {
        const Index* const c = triangles_.corners(t);
        return Around::center(around_.at(c[0]), around_.at(c[1]), around_.at(c[2]));
    }

    void add(Index point, double area) { shares_.push_back({point, area, {}}); }

    // One share for each point; sorted stably, so that sums are always rounded alike.
    void add_up() {
        std::stable_sort(shares_.begin(), shares_.end(),
                         [](const Share& a, const Share& b) { return a.point < b.point; });
        std::size_t size = 0;
        for (const Share& share : shares_) {
            if (size > 0 && shares_[size - 1].point == share.point) {
                Share& sum = shares_[size - 1];
                sum.area += share.area;
                sum.slope = sum.slope + share.slope;
            } else {
                shares_[size++] = share;
            }
        }
        shares_.resize(size);
        total_ = 0.0;
        for (Share& share : shares_) {
            share.area = std::max(share.area, 0.0);
            total_ += share.area;
        }
    }

    // Areas of the three corners, as seen from the query: on the hull of the plane, the limit of the stolen ones.
    void take_triangle(Index t) {
        const Index* const c = triangles_.corners(t);
        shares_.clear();
        total_ = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double area = std::max(outer(around_.at(c[(k + 1) % 3]), around_.at(c[(k + 2) % 3])), 0.0);
            if (area > 0.0) {
                shares_.push_back({c[k], area, {}});
                total_ += area;
            }
        }
        has_slopes_ = false;
    }

    // The heaviest share is the one that the others are compared with.
    void weigh() {
        for (Share& share : shares_) {
            share.weight = share.area / total_;
        }
        const auto lighter = [](const Share& a, const Share& b) { return a.weight < b.weight; };
        const auto heaviest = std::max_element(shares_.begin(), shares_.end(), lighter);
        heaviest_ = static_cast<std::size_t>(heaviest - shares_.begin());
    }

    void put_weights(std::size_t place) {
        for (const Share& share : shares_) {
            task_.members[place] = share.point;
            task_.weights[place++] = share.weight;
        }
    }

    void put(std::size_t k) {
        const std::size_t width = task_.width;
        for (std::size_t j = 0; j < width; ++j) {
            const double* const values = task_.values + j;
            if (shares_.empty()) {
                task_.found[k * width + j] = UNKNOWN;
                put_unknown(k, j);
                continue;
            }
            // From the heaviest value: equal ones stay equal to the last bit.
            const double base = values[static_cast<std::size_t>(shares_[heaviest_].point) * width];
            double above = 0.0;
            for (const Share& share : shares_) {
                above += share.weight * (values[static_cast<std::size_t>(share.point) * width] - base);
            }
            task_.found[k * width + j] = base + above;
            put_gradient(k, j, base, above);
        }
    }

    void put_gradient(std::size_t k, std::size_t j, double base, double above) {
        if (task_.gradients == nullptr || !has_slopes_) {
            put_unknown(k, j);
            return;
        }
        Local gradient{};
        for (const Share& share : shares_) {
            const double rise = task_.values[static_cast<std::size_t>(share.point) * task_.width + j] - base - above;
            gradient.x += share.slope.x * rise;
            gradient.y += share.slope.y * rise;
        }
        gradient.x /= total_;
        gradient.y /= total_;
        around_.put_gradient(gradient, task_.gradients + k * dimension * task_.width + j, task_.width);
    }

    void put_unknown(std::size_t k, std::size_t j) {
        for (std::size_t axis = 0; task_.gradients != nullptr && axis < dimension; ++axis) {
            task_.gradients[(k * dimension + axis) * task_.width + j] = UNKNOWN;
        }
    }

    const NaturalNeighborTask& task_;
    const TriangleArrays& triangles_;
    Query query_;
    Around around_;
    std::vector<Edge> front_, rim_;
    std::vector<Share> shares_;
    double total_ = 0.0;         // of the areas
    std::size_t heaviest_ = 0;  // place in shares_
    bool has_slopes_ = true;
    Stop stop_;
};

}  // namespace

template <std::size_t Width>
void natural_neighbors(const NaturalNeighborTask& task, int workers, Stop stop) {
    using Query = queries::QueryOf<Width>;
    using Around = std::conditional_t<Width == 2, PlaneAround, SphereAround>;
    const Index start = first_open(task.triangles);
    if (start == static_cast<Index>(task.triangles.count())) {
        if (task.counts != nullptr) {
            std::fill_n(task.counts, task.count, 0);
        }
        std::fill_n(task.found, task.count * task.width, UNKNOWN);
        if (task.gradients != nullptr) {
            std::fill_n(task.gradients, task.count * task.width * Query::Chart::dimension, UNKNOWN);
        }
        return;
    }
    for_queries<typename Query::Chart>(task.triangles, start, task.queries, task.count, workers, stop,
                                       [&] { return Interpolation<Query, Around>(task, stop); });
}

template void natural_neighbors<2>(const NaturalNeighborTask&, int, Stop);
template void natural_neighbors<3>(const NaturalNeighborTask&, int, Stop);

}  // namespace stereodel::interpolation
