// A set of point or triangle numbers that is filled and emptied again and again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tally.hpp"

namespace stereodel {

// Open addressing, at most half full. Emptying takes as long as filling did, however large the set once was.
class IndexSet {
  public:
    // Whether the number (not negative) is new.
    bool insert(Index number) {
        if (2 * (members_.size() + 1) > slots_.size()) {
            grow();
        }
        if (!place(number)) {
            return false;
        }
        members_.push_back(number);
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
        const std::size_t slot = slot_of(number);
        if (slots_[slot] == number) {
            return false;
        }
        slots_[slot] = number;
        return true;
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

    void grow() {
        slots_.assign(2 * slots_.size(), FREE);
        for (const Index member : members_) {
            place(member);
        }
    }

    std::vector<Index> slots_ = std::vector<Index>(64, FREE);
    std::vector<Index> members_;
};

}  // namespace stereodel
