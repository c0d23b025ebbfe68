// The numbers of equal points, in order: that of the kept one, then those of its duplicates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "duplicates.hpp"

namespace stereodel::queries {

class EqualPoints {
  public:
    explicit EqualPoints(const Pairs& duplicates) {
        by_kept_.reserve(duplicates.size());
        for (const auto& [dropped, kept] : duplicates) {
            by_kept_.emplace_back(kept, dropped);
        }
        std::sort(by_kept_.begin(), by_kept_.end());
    }

    // One of the numbers; `step` goes to the next one and tells whether there is one.
    struct Place {
        Index kept, number;
        std::size_t next;
    };

    Place first(Index kept) const {
        const auto pair = std::lower_bound(by_kept_.begin(), by_kept_.end(), std::pair<Index, Index>(kept, 0));
        return {kept, kept, static_cast<std::size_t>(pair - by_kept_.begin())};
    }

    bool step(Place& place) const {
        if (place.next == by_kept_.size() || by_kept_[place.next].first != place.kept) {
            return false;
        }
        place.number = by_kept_[place.next++].second;
        return true;
    }

  private:
    Pairs by_kept_;  // kept, dropped
};

}  // namespace stereodel::queries
