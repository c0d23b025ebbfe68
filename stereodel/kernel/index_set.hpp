// A set of point or triangle numbers that is filled and emptied again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tally.hpp"

namespace stereodel {

// A few numbers are a list; more are hashed, with open addressing, at most half full. Emptying takes no longer than
// filling did, however large the set once was.
class IndexSet {
  public:
    // Whether the number (not negative) is new.
    bool insert(Index number) {
        if (members_.size() < FEW) {
            if (std::find(members_.begin(), members_.end(), number) != members_.end()) {
                return false;
            }
        } else {
            if (!hashed_) {
                hash_members();
            } else if (2 * members_.size() >= slots_.size()) {
                slots_.assign(2 * slots_.size(), FREE);
                hash_members();
            }
            if (!place(number)) {
                return false;
            }
        }
        members_.push_back(number);
        return true;
    }

    // The last one in leaves first: the way to its slot then still leads past those that came before it.
    void clear() {
        for (; hashed_ && !members_.empty(); members_.pop_back()) {
            slots_[slot_of(members_.back())] = FREE;
        }
        members_.clear();
        hashed_ = false;
    }

  private:
    static constexpr Index FREE = -1;
    static constexpr std::size_t FEW = 16;

    void hash_members() {
        hashed_ = true;
        for (const Index member : members_) {
            place(member);
        }
    }

    bool place(Index number) {
        Index& slot = slots_[slot_of(number)];
        const bool is_new = slot == FREE;
        slot = number;
        return is_new;
    }

    // Where the number is or would be.
    std::size_t slot_of(Index number) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t slot = (static_cast<std::uint32_t>(number) * 0x9E3779B1u >> 7) & mask;
        while (slots_[slot] != FREE && slots_[slot] != number) {
            slot = (slot + 1) & mask;
        }
        return slot;
    }

    std::vector<Index> members_;
    std::vector<Index> slots_ = std::vector<Index>(8 * FEW, FREE);
    bool hashed_ = false;
};

}  // namespace stereodel
