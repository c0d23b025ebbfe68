// A set of point or triangle numbers that is filled and emptied again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tally.hpp"

namespace stereodel {

// Hashed, with open addressing, at most half full. Emptying takes no longer than filling did, however large the set
// once was.
class IndexSet {
  public:
    // Whether the number (not negative) is new.
    bool insert(Index number) {
        if (!place(number)) {
            return false;
        }
        members_.push_back(number);
        if (2 * members_.size() > slots_.size()) {
            slots_.assign(2 * slots_.size(), FREE);
            for (const Index member : members_) {
                place(member);
            }
        }
        return true;
    }

    // The last one in leaves first: the way to its slot then still leads past those that came before it.
    void clear() {
        for (; !members_.empty(); members_.pop_back()) {
            slots_[slot_of(members_.back())] = FREE;
        }
    }

  private:
    static constexpr Index FREE = -1;

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
    std::vector<Index> slots_ = std::vector<Index>(128, FREE);
};

}  // namespace stereodel
