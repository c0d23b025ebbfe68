#include "partitions/open_bubbles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "memory.hpp"
#include "partitions/bubble_digits.hpp"
#include "partitions/bubble_form.hpp"

namespace stereodel::partitions {

using voronoi::unit_vector;

namespace {

// Where bubbles come from: form(k) in doubles, bubble(k) by the given points, matters(k).
class PlaneFaces {
  public:
    explicit PlaneFaces(const Faces& faces) : faces_(faces) {}

    bool matters(std::size_t k) const {
        const Index* const c = faces_.corners + 3 * k;
        return faces_.wanted == nullptr || faces_.wanted[c[0]] || faces_.wanted[c[1]] ||
               (c[2] >= 0 && faces_.wanted[c[2]]);
    }
    Bubble bubble(std::size_t k) const {
        const Index* const c = faces_.corners + 3 * k;
        return {at(c[0]), at(c[1]), c[2] < 0 ? nullptr : at(c[2])};
    }
    BubbleForm<2> form(std::size_t k) const {
        const Bubble b = bubble(k);
        return bubble_form(b.a, b.b, b.c);
    }

  private:
    const double* at(Index a) const { return faces_.points + 2 * static_cast<std::size_t>(a); }

    const Faces& faces_;
};

class SphereFaces {
  public:
    SphereFaces(const Faces& faces, Stop stop) : faces_(faces), units_(faces.size) {
        for_range(0, faces.size, stop, [&](std::size_t k) { units_[k] = unit_vector(faces.points + 3 * k); });
    }

    bool matters(std::size_t k) const {
        const Index* const c = faces_.corners + 3 * k;
        return faces_.wanted == nullptr || faces_.wanted[c[0]] || faces_.wanted[c[1]] || faces_.wanted[c[2]];
    }
    Bubble bubble(std::size_t k) const {
        const Index* const c = faces_.corners + 3 * k;
        const auto at = [this](Index a) { return faces_.points + 3 * static_cast<std::size_t>(a); };
        return {at(c[0]), at(c[1]), at(c[2])};
    }
    BubbleForm<3> form(std::size_t k) const {
        const Index* const c = faces_.corners + 3 * k;
        const auto unit = [this](Index a) -> const UnitVector& { return units_[static_cast<std::size_t>(a)]; };
        return bubble_form(unit(c[0]), unit(c[1]), unit(c[2]));
    }

  private:
    const Faces& faces_;
    Buffer<UnitVector> units_;
};

template <std::size_t Width>
class Rims {
  public:
    explicit Rims(const Discs& discs) : discs_(discs) {}

    bool matters(std::size_t) const { return true; }
    Bubble bubble(std::size_t k) const { return {discs_.centers + Width * k, discs_.rims + Width * k, nullptr, true}; }
    BubbleForm<Width> form(std::size_t k) const {
        const Bubble disc = bubble(k);
        if constexpr (Width == 2) {
            return disc_form(disc.a, disc.b);
        } else {
            return disc_form(unit_vector(disc.a), unit_vector(disc.b));
        }
    }

  private:
    const Discs& discs_;
};

template <std::size_t Width>
struct AroundAll {
    double low[Width], high[Width];

    AroundAll() {
        std::fill_n(low, Width, std::numeric_limits<double>::infinity());
        std::fill_n(high, Width, -std::numeric_limits<double>::infinity());
    }
    bool is_apart(const double* other_low, const double* other_high) const {
        bool apart = false;
        for (std::size_t k = 0; k < Width; ++k) {
            apart |= (high[k] < other_low[k]) | (low[k] > other_high[k]);
        }
        return apart;
    }
};

// Bubbles come in groups. Mostly no unread block is near, which one box around all balls of a group tells.
template <std::size_t Width, class Source>
class OpenBubbles {
  public:
    OpenBubbles(const Source& source, const BoxTree<Width>& tree, const Openness& openness)
        : source_(source), tree_(tree), search_(tree), openness_(openness), forms_(group_) {}

    void run(std::size_t count, Stop stop) {
        std::fill_n(openness_.is_open, count, false);
        std::fill_n(openness_.depth, tree_.leaves(), 0.0);
        for (std::size_t begin = 0; begin < count; begin += group_) {
            check(stop);
            run_group(begin, std::min(count, begin + group_));
        }
    }

  private:
    static constexpr std::size_t group_ = 64;

    void run_group(std::size_t begin, std::size_t end) {
        AroundAll<Width> around;
        which_.clear();
        for (std::size_t k = begin; k < end; ++k) {
            if (!source_.matters(k)) {
                continue;
            }
            BubbleForm<Width>& form = forms_[which_.size()];
            form = source_.form(k);
            which_.push_back({k, widen_by_ball(form, around.low, around.high)});
        }
        const bool is_near =
            search_.find([&](const double* low, const double* high) { return around.is_apart(low, high); },
                         [](std::size_t) { return true; });
        for (std::size_t k = 0; k < which_.size(); ++k) {
            if (is_near || !which_[k].is_around) {
                run_one(which_[k].number, forms_[k]);
            }
        }
    }

    void run_one(std::size_t number, const BubbleForm<Width>& form) {
        const auto is_free = [&](const double* low, const double* high) {
            return lowest_value(form, low, high).is_positive();
        };
        const auto is_touched = [&](std::size_t leaf) {
            return lowest_value(form, tree_.low(leaf), tree_.high(leaf)).is_negative() ||
                   touches<Width>(source_.bubble(number), tree_.low(leaf), tree_.high(leaf));
        };
        if (!search_.find(is_free, is_touched)) {
            return;
        }
        openness_.is_open[number] = true;
        search_.find_left(is_free, [&](std::size_t leaf) {
            if (is_touched(leaf)) {
                openness_.depth[leaf] = depth(form, leaf);
                search_.leave_out(leaf);
            }
            return false;
        });
    }

    // -f is the distance beyond the triangle's plane (the line of the hull's edge) times the length of (2D, G).
    double depth(const BubbleForm<Width>& form, std::size_t leaf) const {
        double square = 4 * form.square * form.square;
        for (std::size_t k = 0; k < Width; ++k) {
            square += form.linear[k] * form.linear[k];
        }
        const double value = lowest_value(form, tree_.low(leaf), tree_.high(leaf)).value;
        const double depth = -value / std::sqrt(square) / form.scale;
        constexpr double least = std::numeric_limits<double>::min(), most = std::numeric_limits<double>::max();
        return depth > least ? std::min(depth, most) : least;  // not a number, too, where products overflow
    }

    struct Member {
        std::size_t number;
        bool is_around;  // its ball is in the box around all
    };

    const Source& source_;
    const BoxTree<Width>& tree_;
    BoxSearch<Width> search_;
    Openness openness_;
    std::vector<BubbleForm<Width>> forms_;
    std::vector<Member> which_;
};

}  // namespace

void open_bubbles(const Faces& faces, const BoxTree<2>& tree, const Openness& openness, Stop stop) {
    const PlaneFaces source(faces);
    OpenBubbles<2, PlaneFaces>(source, tree, openness).run(faces.count, stop);
}

void open_bubbles(const Faces& faces, const BoxTree<3>& tree, const Openness& openness, Stop stop) {
    const SphereFaces source(faces, stop);
    OpenBubbles<3, SphereFaces>(source, tree, openness).run(faces.count, stop);
}

void open_discs(const Discs& discs, const BoxTree<2>& tree, const Openness& openness, Stop stop) {
    const Rims<2> source(discs);
    OpenBubbles<2, Rims<2>>(source, tree, openness).run(discs.count, stop);
}

void open_discs(const Discs& discs, const BoxTree<3>& tree, const Openness& openness, Stop stop) {
    const Rims<3> source(discs);
    OpenBubbles<3, Rims<3>>(source, tree, openness).run(discs.count, stop);
}

}  // namespace stereodel::partitions
