// The folder `partitions`: what a triangulation in parts asks of points that it has not read.
// Reading order: box_tree (what is known of them), blocks (where the boxes come from); bubble_form (a bubble as a
// quadratic function, and its error), bubble_digits (the same beyond doubles), open_bubbles (which triangles are
// final), open_targets (and which interpolations); site_ids and final_cells: what is told of points whose triangles
// are.
//
// Points come in blocks, each in a box with sides along the axes. A triangle of the points at hand is one of all points
// if no box of a block that was not read touches its closed bubble: that is empty of all other points then, and so is
// its rim, where ties are decided. On the sphere the boxes are those of unit vectors, in space.
//
// Boxes of blocks in a tree: of each `FAN` consecutive ones again a box, and so on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "threads.hpp"

namespace stereodel::partitions {

constexpr std::size_t FAN = 8;

// Nodes of level l, from the leaves up, are [first[l], first[l + 1]); node k of a level has the children
// [FAN k, FAN (k + 1)) below. `unread`: how many leaves with unread points each node has.
template <std::size_t Width>
struct BoxTree {
    const double *lows, *highs;
    const std::int64_t* first;
    std::size_t levels;
    const std::int32_t* unread;

    std::size_t begin(std::size_t level) const { return static_cast<std::size_t>(first[level]); }
    std::size_t size(std::size_t level) const { return begin(level + 1) - begin(level); }
    std::size_t leaves() const { return size(0); }
    std::size_t nodes() const { return begin(levels); }
    const double* low(std::size_t node) const { return lows + Width * node; }
    const double* high(std::size_t node) const { return highs + Width * node; }
};

// The first node of each level of a tree with so many leaves, and of one beyond.
std::vector<std::int64_t> tree_levels(std::size_t leaves);

// Throws std::invalid_argument if these are not those levels.
void check_levels(const std::int64_t* first, std::size_t count, std::size_t nodes);

// The boxes of all nodes from those of the leaves, which stand first.
void fill_boxes(const std::vector<std::int64_t>& first, std::size_t width, double* lows, double* highs);

// From those of the leaves, which stand first.
void fill_counts(const std::int64_t* first, std::size_t levels, std::int32_t* counts);

// Searches of one tree, one after another. Leaves can be left out of those that follow.
template <std::size_t Width>
class BoxSearch {
  public:
    explicit BoxSearch(const BoxTree<Width>& tree) : tree_(tree) {}

    // Calls visit(leaf) for unread leaves that, like all nodes above them, is_apart(low, high) does not hold for, until
    // one returns true. Returns whether one did.
    template <class IsApart, class Visit>
    bool find(IsApart&& is_apart, Visit&& visit) {
        return search(tree_.unread, is_apart, visit);
    }

    // The same without the leaves that were left out.
    template <class IsApart, class Visit>
    bool find_left(IsApart&& is_apart, Visit&& visit) {
        if (left_.size() == 0) {
            left_ = Buffer<std::int32_t>(tree_.nodes());
            std::copy(tree_.unread, tree_.unread + tree_.nodes(), left_.data());
        }
        return search(left_.data(), is_apart, visit);
    }

    // After the first `find_left`.
    void leave_out(std::size_t leaf) {
        for (std::size_t level = 0; level < tree_.levels; ++level, leaf /= FAN) {
            --left_[tree_.begin(level) + leaf];
        }
    }

  private:
    struct Node {
        std::size_t level, number;
    };

    template <class IsApart, class Visit>
    bool search(const std::int32_t* unread, IsApart&& is_apart, Visit&& visit) {
        stack_.clear();
        push(tree_.levels - 1, 0, tree_.size(tree_.levels - 1));
        while (!stack_.empty()) {
            const Node node = stack_.back();
            stack_.pop_back();
            const std::size_t at = tree_.begin(node.level) + node.number;
            if (unread[at] == 0 || is_apart(tree_.low(at), tree_.high(at))) {
                continue;
            }
            if (node.level > 0) {
                const std::size_t begin = FAN * node.number;
                push(node.level - 1, begin, std::min(begin + FAN, tree_.size(node.level - 1)));
            } else if (visit(node.number)) {
                return true;
            }
        }
        return false;
    }

    void push(std::size_t level, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            stack_.push_back({level, k});
        }
    }

    const BoxTree<Width>& tree_;
    std::vector<Node> stack_;
    Buffer<std::int32_t> left_;
};

// Marks leaves with unread points near chosen ones: the gap along each axis is at most `reach` times the smaller of
// the two boxes' diagonals.
template <std::size_t Width>
void near_blocks(const BoxTree<Width>& tree, const bool* chosen, double reach, bool* near, Stop stop);

}  // namespace stereodel::partitions
