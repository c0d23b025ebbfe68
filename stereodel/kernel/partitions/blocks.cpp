#include "partitions/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "voronoi/unit_vectors.hpp"

namespace stereodel::partitions {

using voronoi::unit_vector;

namespace {

// Coordinates beside the number of their row: what is moved while blocks are made, so that nothing is read out of turn.
template <std::size_t Width>
struct Place {
    double x[Width];
    Index row;
};

template <std::size_t Width>
struct Box {
    double low[Width], high[Width];

    explicit Box(const Place<Width>& place) {
        std::copy_n(place.x, Width, low);
        std::copy_n(place.x, Width, high);
    }

    void add(const Place<Width>& place) {
        for (std::size_t k = 0; k < Width; ++k) {
            low[k] = std::min(low[k], place.x[k]);
            high[k] = std::max(high[k], place.x[k]);
        }
    }

    std::size_t widest() const {
        std::size_t axis = 0;
        for (std::size_t k = 1; k < Width; ++k) {
            axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
        }
        return axis;
    }
};

template <std::size_t Width>
class Halving {
  public:
    Halving(Buffer<Place<Width>>& places, std::size_t most, Stop stop, Blocks& blocks)
        : places_(places.data()), most_(most), stop_(stop), blocks_(blocks) {
        blocks_.starts.push_back(0);
        if (places.size() > 0) {
            divide(0, places.size());
        }
    }

  private:
    void divide(std::size_t begin, std::size_t end) {
        check(stop_);
        Box<Width> box(places_[begin]);
        for (std::size_t k = begin + 1; k < end; ++k) {
            box.add(places_[k]);
        }
        const std::size_t axis = box.widest();
        const std::size_t middle =
            end - begin <= most_ || box.low[axis] == box.high[axis] ? begin : split(begin, end, axis);
        if (middle != begin) {
            divide(begin, middle);
            divide(middle, end);
            return;
        }
        blocks_.starts.push_back(static_cast<std::int64_t>(end));
        blocks_.lows.insert(blocks_.lows.end(), box.low, box.low + Width);
        blocks_.highs.insert(blocks_.highs.end(), box.high, box.high + Width);
    }

    // Where the coordinates grow next to the middle: those before are less than those from there on.
    std::size_t split(std::size_t begin, std::size_t end, std::size_t axis) {
        const std::size_t middle = begin + (end - begin) / 2;
        Place<Width>*const first = places_ + begin, *const last = places_ + end;
        std::nth_element(first, places_ + middle, last,
                         [axis](const auto& a, const auto& b) { return a.x[axis] < b.x[axis]; });
        const double value = places_[middle].x[axis];
        Place<Width>* const from = std::partition(first, last, [&](const auto& p) { return p.x[axis] < value; });
        Place<Width>* const to = std::partition(from, last, [&](const auto& p) { return !(p.x[axis] > value); });
        const auto below = static_cast<std::size_t>(from - places_), above = static_cast<std::size_t>(to - places_);
        return below != begin && (above == end || middle - below <= above - middle) ? below : above;
    }

    Place<Width>* places_;
    std::size_t most_;
    Stop stop_;
    Blocks& blocks_;
};

// The high part of a unit vector is the double next to the sum of both or a neighbour of that, and the sum is off by
// 2^-101: two steps of doubles or 2^-100 away from it there is nothing.
double below(double x) {
    return std::nextafter(std::nextafter(x, -2.0), -2.0) - 0x1p-100;
}

}  // namespace

template <std::size_t Width>
void parts(const double* points, std::size_t size, const Splits& splits, std::int32_t* part, Stop stop) {
    for_range(0, size, stop, [&](std::size_t k) {
        double unit[3];
        const double* point = points + Width * k;
        if constexpr (Width == 3) {
            std::copy_n(unit_vector(point).hi, 3, unit);
            point = unit;
        }
        std::size_t node = 0;
        while (node < splits.count) {
            node = 2 * node + (point[splits.axis[node]] <= splits.value[node] ? 1 : 2);
        }
        part[k] = static_cast<std::int32_t>(node - splits.count);
    });
}

template <std::size_t Width>
Blocks blocks(const double* points, std::size_t size, std::size_t most, Stop stop) {
    Buffer<Place<Width>> places(size);
    for_range(0, size, stop, [&](std::size_t k) {
        const double* const point = points + Width * k;
        if constexpr (Width == 2) {
            std::copy_n(point, Width, places[k].x);
        } else {
            std::copy_n(unit_vector(point).hi, Width, places[k].x);
        }
        places[k].row = static_cast<Index>(k);
    });
    Blocks blocks;
    Halving<Width>(places, most, stop, blocks);
    blocks.order = Buffer<Index>(size);
    for_range(0, size, stop, [&](std::size_t k) { blocks.order[k] = places[k].row; });
    for (std::size_t k = 0; k < blocks.lows.size() && Width == 3; ++k) {
        blocks.lows[k] = below(blocks.lows[k]);
        blocks.highs[k] = -below(-blocks.highs[k]);
    }
    return blocks;
}

template void parts<2>(const double*, std::size_t, const Splits&, std::int32_t*, Stop);
template void parts<3>(const double*, std::size_t, const Splits&, std::int32_t*, Stop);
template Blocks blocks<2>(const double*, std::size_t, std::size_t, Stop);
template Blocks blocks<3>(const double*, std::size_t, std::size_t, Stop);

}  // namespace stereodel::partitions
