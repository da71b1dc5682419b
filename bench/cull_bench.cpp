// Frustum culling: the BVH against testing every box with the same scalar predicate.
//
// 100,000 boxes of a flat city-like world, 1,000 views that see about 5 % of them. Both ways answer
// each view in turn, so that a slow moment of the machine hits both; sorting is in neither. Every
// answer is compared. Then 1,000 of the boxes wander, round after round, and refitting is compared
// with building anew, answers too. Prints its tables to stdout; exits with 1 if an answer differs.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "quick.hpp"
#include "scene/bvh.hpp"

namespace {

using namespace lucerna;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kBoxes = 100'000;
constexpr std::size_t kMoving = 1000;
constexpr int kViewsPerRound = 10;
constexpr float kExtent = 1000;  // m, half the side of the world

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::vector<Aabb> makeBoxes(Random& random) {
  std::vector<Aabb> boxes(kBoxes);
  for (Aabb& box : boxes) {
    const float x = random.uniform(-kExtent, kExtent), y = random.uniform(0, 40);
    box.grow(vec3(x, y, random.uniform(-kExtent, kExtent)));
    const float width = random.uniform(0.2f, 6), height = random.uniform(0.2f, 6);
    box.max += vec3(width, height, random.uniform(0.2f, 6));
  }
  return boxes;
}

// Cameras at street level near the middle, looking any way, far plane at `range`.
Frustum makeView(Random& random, float range) {
  const float x = random.uniform(-0.5f, 0.5f) * kExtent, z = random.uniform(-0.5f, 0.5f) * kExtent;
  const float heading = random.uniform(0, 6.2831853f), pitch = random.uniform(-0.2f, 0.2f);
  const vec3 eye(x, random.uniform(1.5f, 30), z);
  const vec3 ahead(std::cos(heading), pitch, std::sin(heading));
  const mat4 viewFromWorld = glm::lookAt(eye, eye + ahead, vec3(0, 1, 0));
  return frustumOf(perspectiveReversed(0.9f, 16.f / 9, 0.1f, range) * viewFromWorld);
}

void testEveryBox(const Frustum& frustum, const std::vector<Aabb>& boxes,
                  std::vector<std::uint32_t>& items) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    if (intersects(frustum, boxes[i])) items.push_back(i);
}

// True if the refitted tree answers like testing every box, in every round.
bool benchRefit(std::vector<Aabb> boxes, Random& random, int rounds) {
  scene::Bvh refitted, built;
  refitted.build(boxes);
  std::vector<double> refitTimes, buildTimes;
  bool equal = true;
  int kept = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::uint32_t> moved;
    std::vector<Aabb> to;
    for (std::size_t i = 0; i < kMoving; ++i) {
      const auto item = static_cast<std::uint32_t>(random.below(kBoxes));
      const float x = random.uniform(-5, 5), y = random.uniform(-1, 1);
      const vec3 step(x, y, random.uniform(-5, 5));
      boxes[item] = {boxes[item].min + step, boxes[item].max + step};
      moved.push_back(item);
      to.push_back(boxes[item]);
    }
    auto start = Clock::now();
    kept += refitted.refit(moved, to);
    refitTimes.push_back(millisecondsSince(start));
    start = Clock::now();
    built.build(boxes);
    buildTimes.push_back(millisecondsSince(start));
    for (int view = 0; view < kViewsPerRound; ++view) {
      const Frustum frustum = makeView(random, 720);
      std::vector<std::uint32_t> expected, found;
      testEveryBox(frustum, boxes, expected);
      refitted.query(frustum, found);
      std::sort(found.begin(), found.end());
      equal = equal && found == expected;
    }
  }
  const double refit = median(refitTimes), build = median(buildTimes);
  fmt::print(
      "{} of {} boxes move: refit {:.3f} ms, build {:.1f} ms, ratio {:.4f}; {} of {} rounds "
      "refitted; answers {}\n",
      kMoving, kBoxes, refit, build, refit / build, kept, rounds,
      equal ? "equal in every view" : "DIFFER");
  return equal;
}

}  // namespace

int main(int count, char** words) {
  const bool quick = isQuick(count, words);
  const int views = quick ? 20 : 1000, rounds = quick ? 2 : 30;
  Random random(1);
  const std::vector<Aabb> boxes = makeBoxes(random);

  scene::Bvh bvh;
  std::vector<double> buildTimes;
  for (int run = 0; run < 7; ++run) {
    const auto start = Clock::now();
    bvh.build(boxes);
    buildTimes.push_back(millisecondsSince(start));
  }
  fmt::print("build of {} boxes: {:.1f} ms, {} nodes\n", kBoxes, median(buildTimes),
             bvh.nodes().size());
  fmt::print("{:>8} {:>9} {:>14} {:>10} {:>7}\n", "range/m", "visible", "every box/ms", "BVH/ms",
             "ratio");

  bool equal = true;
  for (const float range : {300.f, 500.f, 720.f, 1000.f, 4000.f}) {
    std::vector<double> everyTimes, bvhTimes;
    std::vector<std::uint32_t> expected, found;
    std::size_t visible = 0;
    for (int view = 0; view < views; ++view) {
      const Frustum frustum = makeView(random, range);
      expected.clear();
      found.clear();
      auto start = Clock::now();
      testEveryBox(frustum, boxes, expected);
      everyTimes.push_back(millisecondsSince(start));
      start = Clock::now();
      bvh.query(frustum, found);
      bvhTimes.push_back(millisecondsSince(start));
      visible += expected.size();
      std::sort(found.begin(), found.end());
      equal = equal && found == expected;
    }
    const double every = median(everyTimes), hierarchy = median(bvhTimes);
    fmt::print("{:>8.0f} {:>8.2f}% {:>14.3f} {:>10.4f} {:>7.3f}\n", range,
               100.0 * static_cast<double>(visible) / (views * static_cast<double>(kBoxes)), every,
               hierarchy, hierarchy / every);
  }
  fmt::print("answers {}\n", equal ? "equal in every view" : "DIFFER");
  const bool refitEqual = benchRefit(boxes, random, rounds);
  return equal && refitEqual ? 0 : 1;
}
