#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "cell_border.h"
#include "cell_flood.h"
#include "level_path.h"
#include "niche_properties.h"

namespace concave_distance::detail {

/// Which local minima are niches of their own, proven at each pose; and what proves it, kept for the next
/// one: paths to deeper places and borders around niches. Belongs to one pair of bodies.
class MinimaVerdicts {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kUndecided = 0xfffffffeU;

  enum class Verdict : std::uint8_t {
    Open,
    Niche,      ///< nothing deeper is reached below (1 + least prominence) times its distance
    Ripple,     ///< something deeper is, or the same set of minima has another seed
    Undecided,  ///< the limit was reached
    Unwanted    ///< neither a known ripple nor wanted, or after as many niches as are wanted
  };
  struct Judged {
    MinimumSeed seed;
    Verdict verdict = Verdict::Open;
    bool was_found = false;      ///< not by a seed, but by a flood or by locate()
    std::uint32_t into = kNone;  ///< of a ripple: the deeper one, if known
    TrianglePair below;          ///< and if not: a place deeper than it
    std::uint64_t region = 0;    ///< of a niche: the same while its border is; 0: none
  };
  struct Counts {
    std::uint32_t by_path = 0;    ///< ripples by known paths
    std::uint32_t by_border = 0;  ///< niches by known borders
    std::uint32_t mended = 0;     ///< niches by borders with more cells inside
    std::uint32_t floods = 0;
    std::uint32_t flooded_cells = 0;
    std::uint32_t measured = 0;  ///< elements of borders, anew
  };
  struct Request {
    double least_prominence = 1e-2;
    std::size_t most_niches = std::numeric_limits<std::size_t>::max();
    /// Niches through material are wanted; else nothing is judged that begins there.
    bool through_material = false;
    bool is_tracked = true;  ///< what proves a verdict is kept for the next pose
    /// Whether a seed that is no known ripple is wanted; empty: all are. The occluder is kept with the seed's
    /// triangle pair.
    std::function<bool(const MinimumSeed&, Occluder&)> is_wanted;
  };

  void clear();

  /// At a new pose: puts the seeds in ascending order; results stand in the same order, and after them places
  /// that only floods have found.
  void begin(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
             WorkLimit& limit);
  /// Judges seeds whose verdict needs no flood, until there are Request::most_niches more.
  void judgeByMemory(const MinimaScene& scene, const Request& request, WorkLimit& limit);
  /// Judges those that the last call has left open.
  void judgeByFloods(const MinimaScene& scene, const Request& request, WorkLimit& limit);
  bool hasJudgedAll() const { return next_ >= seed_count_; }
  /// All of it, until there are Request::most_niches.
  void judge(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
             WorkLimit& limit);

  /// At the pose of the last begin(): the niche of the local minimum around a triangle pair, as an index of
  /// judged(); kNone when that is none of them, kUndecided when the limit was reached. A place that is a
  /// niche of its own is judged and added.
  std::uint32_t locate(const MinimaScene& scene, const TrianglePair& around, const Request& request,
                       WorkLimit& limit);
  /// The niche with this region; kNone when there is none any more.
  std::uint32_t nicheWith(std::uint64_t region) const;

  const std::vector<Judged>& judged() const { return judged_; }
  const Counts& counts() const { return counts_; }
  std::size_t memoryBytes() const;

 private:
  class Stage;
  void dropUnconfirmed();
  void drop(std::uint32_t region);
  void compact();
  /// Of a ripple and those it leads to, the last.
  std::uint32_t endOf(std::uint32_t index) const;
  std::uint32_t nicheOf(std::uint32_t index) const;

  /// A triangle pair that something is known of.
  struct Cell {
    TriangleIndex a;
    TriangleIndex b;
    std::uint32_t link = kNone;     ///< of links_: the way on
    std::uint32_t low = kNone;      ///< of links_: a point pair in it
    std::uint32_t regions = kNone;  ///< first of its memberships
    std::uint32_t seed = kNone;     ///< of this cycle, if `cycle` is this one
    Occluder occluder;
    std::uint64_t cycle = 0;
  };
  /// A point of each body, own axes in the scene's centre, in a cell and in the next one.
  struct Link {
    Eigen::Vector3d point_a;
    Eigen::Vector3d point_b;
    std::uint32_t next;
    std::uint64_t used = 0;  ///< the last cycle
  };
  struct Membership {
    std::uint32_t region;
    std::uint32_t cell;
    std::uint32_t next;  ///< of the cell
    std::uint32_t next_of_region;
  };
  /// Cells that are connected and enclosed.
  struct Region {
    std::uint64_t id = 0;         ///< 0: free; else its place in the list is the lower half
    std::uint32_t first = kNone;  ///< seed of this cycle
    bool confirmed = false;       ///< in this cycle
    CellBorder border;
    std::uint32_t members = kNone;  ///< first of its memberships
    std::size_t cells = 0;
    std::size_t cells_at_begin = 0;
  };

  PairTable table_{8};
  std::vector<Cell> cells_;
  std::vector<Link> links_;
  std::vector<Membership> memberships_;
  std::uint32_t free_membership_ = kNone;
  std::vector<Region> regions_;
  BorderPool borders_;
  std::vector<std::uint32_t> free_regions_;
  std::uint64_t regions_made_ = 0;
  std::uint64_t cycle_ = 0;
  std::size_t live_cells_ = 0;  ///< after the last compaction
  // Buffers of a compaction.
  std::vector<char> live_;
  std::vector<std::uint32_t> places_;
  std::vector<Link> spare_links_;
  CellFlood flood_;
  LevelPathBuffers path_;
  RefinementWorkspace refinement_;
  std::vector<Judged> judged_;
  PairTable deepest_{4};          ///< first seed of each pair of pieces
  std::uint32_t seed_count_ = 0;  ///< of judged_, the rest was found
  std::uint32_t next_ = 0;        ///< of the seeds, the first that is not judged
  std::uint32_t end_ = 0;         ///< of the seeds looked up in the memory
  std::uint32_t turn_ = 0;        ///< of the seeds, whose is the next flood
  bool floods_are_long_ = false;
  bool is_far_ = false;
  Counts counts_;
};

}  // namespace concave_distance::detail
