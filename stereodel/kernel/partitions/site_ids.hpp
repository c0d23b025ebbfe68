// The sites of a triangulation of some of all points by their ids: where points are equal, the lowest one counts,
// though the triangulation kept the first row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "partitions/final_cells.hpp"

namespace stereodel::partitions {

class SiteIds {
  public:
    explicit SiteIds(const PartialMesh& mesh) : ids_(mesh.ids), lowest_(mesh.ids) {
        if (mesh.duplicates.empty()) {
            return;
        }
        site_ = Buffer<Index>(mesh.size);
        row_ = Buffer<Index>(mesh.size);
        own_ = Buffer<std::int64_t>(mesh.size);
        for (std::size_t k = 0; k < mesh.size; ++k) {
            site_[k] = row_[k] = static_cast<Index>(k);
            own_[k] = mesh.ids[k];
        }
        for (const auto& [dropped, kept] : mesh.duplicates) {
            site_[static_cast<std::size_t>(dropped)] = kept;
            members_.push_back({kept, mesh.ids[dropped], dropped});
            members_.push_back({kept, mesh.ids[kept], kept});
        }
        std::sort(members_.begin(), members_.end());
        members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
        for (std::size_t k = members_.size(); k-- > 0;) {  // the first one of a site comes last
            const auto site = static_cast<std::size_t>(members_[k].site);
            row_[site] = members_[k].row;
            own_[site] = members_[k].id;
        }
        lowest_ = own_.data();
    }

    // The row that the triangulation kept.
    Index site(Index row) const { return site_.size() == 0 ? row : site_[static_cast<std::size_t>(row)]; }
    // The lowest id of a site's points.
    std::int64_t of(Index site) const { return lowest_[site]; }
    const std::int64_t* all() const { return lowest_; }  // of each row that is a site
    bool is_kept(Index row) const { return ids_[row] == of(site(row)); }

    // The lowest id of the other points that are equal to that of a row, -1 if there is none.
    std::int64_t equal_to(Index row) const {
        const auto first = std::lower_bound(members_.begin(), members_.end(), Member{site(row), INT64_MIN, 0});
        if (first == members_.end() || first->site != site(row)) {
            return -1;
        }
        return first->row == row ? (first + 1)->id : first->id;
    }

    // The row of a site's point of lowest id.
    Index row(Index site) const { return row_.size() == 0 ? site : row_[static_cast<std::size_t>(site)]; }

  private:
    struct Member {
        Index site;
        std::int64_t id;
        Index row;

        bool operator<(const Member& other) const {
            return site != other.site ? site < other.site : id != other.id ? id < other.id : row < other.row;
        }
        bool operator==(const Member& other) const { return row == other.row; }
    };

    const std::int64_t *ids_, *lowest_;
    Buffer<Index> site_, row_;    // empty without duplicates, as all that follow
    Buffer<std::int64_t> own_;
    std::vector<Member> members_;  // of sites with several points, by site and id
};

}  // namespace stereodel::partitions
