// Build: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned).
// Query: plane masks after Assarsson and Moeller, "Optimized View Frustum Culling Algorithms for
// Bounding Boxes", 2000.
#include "scene/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/check.hpp"
#include "scene/extent.hpp"

namespace lucerna::scene {
namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kLeafSize = 4;
// Beyond this depth the range is halved, so that no input makes the tree deeper than a stack.
constexpr std::uint32_t kMaxSahDepth = 60;
constexpr std::size_t kMaxDepth = kMaxSahDepth + 33;
constexpr std::uint32_t kNoSlot = ~0u;
// Refitting is given up when the summed areas, and with them what a query visits, have grown so.
constexpr double kMaxAreaGrowth = 2;
// From this share of the items on, fitting every node once is cheaper than walking up from each.
constexpr std::size_t kSweepShare = 8;

float halfArea(const Aabb& box) {
  const vec3 e = box.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

struct Reference {
  Aabb box;
  vec3 center;
  std::uint32_t item;
};

struct Bin {
  Aabb box;
  std::uint32_t count = 0;
};

struct Split {
  int axis = -1;  // -1: none
  int bin = 0;    // the first bin of the right side
};

// Maps centres to bins along one axis; the same function serves counting and partitioning.
struct Binning {
  float origin = 0, scale = 0;
  int operator()(float center) const {
    return std::min(static_cast<int>((center - origin) * scale), kBins - 1);
  }
};

Binning binningOf(const Aabb& centers, int axis) {
  const float scale = kBins / (centers.max[axis] - centers.min[axis]);
  return {centers.min[axis], std::isfinite(scale) ? scale : 0.f};  // 0: they are as good as one
}

// Cost of the best split of one axis, left to right sums of area times count.
float bestSplit(const std::array<Bin, kBins>& bins, int& best) {
  std::array<float, kBins> rightCost{};
  Aabb box;
  std::uint32_t count = 0;
  for (int i = kBins - 1; i > 0; --i) {
    box.grow(bins[i].box);
    count += bins[i].count;
    rightCost[i] = count ? halfArea(box) * static_cast<float>(count) : 0.f;
  }
  box = {};
  count = 0;
  float bestCost = std::numeric_limits<float>::infinity();
  for (int i = 1; i < kBins; ++i) {
    box.grow(bins[i - 1].box);
    count += bins[i - 1].count;
    if (count == 0 || rightCost[i] == 0.f) continue;
    const float cost = halfArea(box) * static_cast<float>(count) + rightCost[i];
    if (cost < bestCost) {
      bestCost = cost;
      best = i;
    }
  }
  return bestCost;
}

Split chooseSplit(std::span<const Reference> references, const Aabb& centers) {
  std::array<std::array<Bin, kBins>, 3> bins;
  std::array<Binning, 3> binnings;
  for (int axis = 0; axis < 3; ++axis) binnings[axis] = binningOf(centers, axis);
  for (const Reference& reference : references) {
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins[axis][binnings[axis](reference.center[axis])];
      bin.box.grow(reference.box);
      ++bin.count;
    }
  }
  Split split;
  float bestCost = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (binnings[axis].scale == 0.f) continue;
    int bin = 0;
    if (const float cost = bestSplit(bins[axis], bin); cost < bestCost) {
      bestCost = cost;
      split = {axis, bin};
    }
  }
  return split;
}

// The number of references on the left side, at least one and not all.
std::size_t partition(std::span<Reference> references, const Aabb& centers, std::uint32_t depth) {
  const std::size_t half = references.size() / 2;
  if (depth >= kMaxSahDepth) return half;
  const Split split = chooseSplit(references, centers);
  if (split.axis < 0) return half;
  const Binning binning = binningOf(centers, split.axis);
  const auto middle = std::partition(references.begin(), references.end(), [&](const Reference& r) {
    return binning(r.center[split.axis]) < split.bin;
  });
  const auto left = static_cast<std::size_t>(middle - references.begin());
  return left == 0 || left == references.size() ? half : left;
}

// The value that intersects() compares with zero, for the corner that `far` picks along the normal.
//
// Every operation in it rounds monotonically, so along one plane normal a box inside another never
// has a larger far-corner value or a smaller near-corner value, to the last bit. Hence a rejected
// node has only rejected items, and a node whose near corner is inside a plane has only items that
// pass it: the query equals the leaf test without any tolerance.
template <bool far>
float cornerValue(const vec4& plane, const Aabb& box) {
  const float x = plane.x * ((plane.x >= 0) == far ? box.max.x : box.min.x);
  const float y = plane.y * ((plane.y >= 0) == far ? box.max.y : box.min.y);
  const float z = plane.z * ((plane.z >= 0) == far ? box.max.z : box.min.z);
  return x + y + z + plane.w;
}

constexpr std::uint32_t kAllPlanes = 0b111111;
constexpr std::uint32_t kOutside = ~0u;

// The planes of `mask` that the box still crosses, or kOutside.
std::uint32_t planesCrossed(const Frustum& frustum, std::uint32_t mask, const Aabb& box) {
  std::uint32_t crossed = 0;
  for (std::uint32_t i = 0; i < 6; ++i) {
    if (!(mask & (1u << i))) continue;
    if (cornerValue<true>(frustum.planes[i], box) < 0) return kOutside;
    if (!(cornerValue<false>(frustum.planes[i], box) >= 0)) crossed |= 1u << i;
  }
  return crossed;
}

bool meet(const Aabb& a, const Aabb& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

bool passes(const Frustum& frustum, std::uint32_t mask, const Aabb& box) {
  for (std::uint32_t i = 0; i < 6; ++i)
    if ((mask & (1u << i)) && cornerValue<true>(frustum.planes[i], box) < 0) return false;
  return true;
}

}  // namespace

void Bvh::build(std::span<const Aabb> boxes) {
  CHECK(boxes.size() < (1u << 31), "{} boxes", boxes.size());
  nodes_.clear();
  ranges_.clear();
  items_.clear();
  boxes_.clear();

  std::vector<Reference> references;
  references.reserve(boxes.size());
  std::vector<std::uint32_t> unbounded;
  for (std::uint32_t item = 0; item < boxes.size(); ++item) {
    const Aabb& box = boxes[item];
    if (box.empty()) continue;
    if (withinReach(box))
      references.push_back({box, box.center(), item});
    else
      unbounded.push_back(item);
  }

  struct Task {
    std::uint32_t node, first, count, depth;
  };
  std::vector<Task> tasks;
  boundedCount_ = static_cast<std::uint32_t>(references.size());
  if (boundedCount_ > 0) {
    nodes_.reserve(boundedCount_);
    nodes_.emplace_back();
    ranges_.emplace_back();
    tasks.push_back({0, 0, boundedCount_, 0});
  }
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const std::span<Reference> range(references.data() + task.first, task.count);
    Aabb box, centers;
    for (const Reference& reference : range) {
      box.grow(reference.box);
      centers.grow(reference.center);
    }
    ranges_[task.node] = {task.first, task.count};
    nodes_[task.node] = {box, task.first, task.count};
    if (task.count <= kLeafSize) continue;
    const auto left = static_cast<std::uint32_t>(partition(range, centers, task.depth));
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[task.node].first = child;
    nodes_[task.node].count = 0;
    nodes_.resize(child + 2);
    ranges_.resize(child + 2);
    tasks.push_back({child + 1, task.first + left, task.count - left, task.depth + 1});
    tasks.push_back({child, task.first, left, task.depth + 1});
  }

  items_.reserve(references.size() + unbounded.size());
  boxes_.reserve(items_.capacity());
  for (const Reference& reference : references) {
    items_.push_back(reference.item);
    boxes_.push_back(reference.box);
  }
  for (const std::uint32_t item : unbounded) {
    items_.push_back(item);
    boxes_.push_back(boxes[item]);
  }
  slots_.assign(boxes.size(), kNoSlot);
  for (std::uint32_t slot = 0; slot < items_.size(); ++slot) slots_[items_[slot]] = slot;
  linkUpwards();
}

void Bvh::linkUpwards() {
  parents_.assign(nodes_.size(), 0);
  leaves_.assign(boundedCount_, 0);
  area_ = 0;
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    area_ += halfArea(node.box);
    if (node.count == 0)
      parents_[node.first] = parents_[node.first + 1] = i;
    else
      std::fill_n(leaves_.begin() + node.first, node.count, i);
  }
  builtArea_ = area_;
}

bool Bvh::fit(std::uint32_t index) {
  Node& node = nodes_[index];
  Aabb box;
  if (node.count == 0) {
    box = nodes_[node.first].box;
    box.grow(nodes_[node.first + 1].box);
  } else {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) box.grow(boxes_[i]);
  }
  if (box.min == node.box.min && box.max == node.box.max) return false;
  area_ += static_cast<double>(halfArea(box)) - halfArea(node.box);
  node.box = box;
  return true;
}

bool Bvh::refit(std::span<const std::uint32_t> items, std::span<const Aabb> boxes) {
  CHECK(items.size() == boxes.size(), "{} items, {} boxes", items.size(), boxes.size());
  const auto inTree = [&](std::uint32_t item) {
    CHECK(item < slots_.size(), "item {} of {}", item, slots_.size());
    return slots_[item] < boundedCount_;
  };
  const bool fits =
      std::ranges::all_of(items, inTree) &&
      std::ranges::all_of(boxes, [](const Aabb& box) { return !box.empty() && withinReach(box); });
  if (!fits) {
    rebuild(items, boxes);
    return false;
  }
  for (std::size_t i = 0; i < items.size(); ++i) boxes_[slots_[items[i]]] = boxes[i];
  if (items.size() > boundedCount_ / kSweepShare) {
    for (auto node = static_cast<std::uint32_t>(nodes_.size()); node-- > 0;) fit(node);
  } else {
    for (const std::uint32_t item : items)
      for (std::uint32_t node = leaves_[slots_[item]]; fit(node) && node != 0;)
        node = parents_[node];
  }
  if (area_ <= kMaxAreaGrowth * builtArea_) return true;
  rebuild(items, boxes);
  return false;
}

void Bvh::rebuild(std::span<const std::uint32_t> items, std::span<const Aabb> boxes) {
  std::vector<Aabb> all(slots_.size());
  for (std::size_t slot = 0; slot < items_.size(); ++slot) all[items_[slot]] = boxes_[slot];
  for (std::size_t i = 0; i < items.size(); ++i) all[items[i]] = boxes[i];
  build(all);
}

void Bvh::query(const Frustum& frustum, std::vector<std::uint32_t>& items) const {
  for (std::size_t i = boundedCount_; i < items_.size(); ++i)
    if (passes(frustum, kAllPlanes, boxes_[i])) items.push_back(items_[i]);
  if (nodes_.empty()) return;

  struct Visit {
    std::uint32_t node, mask;
  };
  std::array<Visit, kMaxDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, kAllPlanes};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    const Node& node = nodes_[visit.node];
    const std::uint32_t mask = planesCrossed(frustum, visit.mask, node.box);
    if (mask == kOutside) continue;
    if (mask == 0) {
      const Range range = ranges_[visit.node];
      const auto first = items_.begin() + range.first;
      items.insert(items.end(), first, first + range.count);
    } else if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (passes(frustum, mask, boxes_[i])) items.push_back(items_[i]);
    } else {
      stack[depth++] = {node.first + 1, mask};
      stack[depth++] = {node.first, mask};
    }
  }
}

void Bvh::query(const Aabb& box, std::vector<std::uint32_t>& items) const {
  for (std::size_t i = boundedCount_; i < items_.size(); ++i)
    if (meet(box, boxes_[i])) items.push_back(items_[i]);
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kMaxDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!meet(box, node.box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (meet(box, boxes_[i])) items.push_back(items_[i]);
  }
}

float Bvh::firstSide(vec3 origin, vec3 direction) const {
  float nearest = std::numeric_limits<float>::infinity();
  if (nodes_.empty()) return nearest;
  std::array<std::uint32_t, kMaxDepth + 1> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    const RaySpan span = spanInside(node.box, origin, direction);
    if (span.first > span.last || span.first >= nearest) continue;
    if (node.count == 0) {
      stack[depth++] = node.first + 1;
      stack[depth++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const RaySpan inside = spanInside(boxes_[i], origin, direction);
      if (inside.first <= inside.last)
        nearest = std::min(nearest, inside.first > 0.f ? inside.first : inside.last);
    }
  }
  return nearest;
}

}  // namespace lucerna::scene
