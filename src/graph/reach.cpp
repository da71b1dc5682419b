#include "graph/reach.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "graph/size_relation.hpp"

namespace lucerna::graph {
namespace {

class Reaches {
 public:
  explicit Reaches(const Plan& plan) : plan_(plan), sizes_(plan) {}

  Reach run() {
    Reach result{.pixels = of(plan_.output)};
    for (const Source& kept : plan_.kept) result.pixels = std::max(result.pixels, of(kept));
    result.whole = whole_;
    return result;
  }

 private:
  int of(const Source& source) {
    if (source.kind != Source::Kind::Output) return 0;
    // The first entry ends circles, which only history inputs can close.
    const auto [known, isNew] = rows_.emplace(source.row, 0);
    if (!isNew) return known->second;
    const auto row = std::ranges::find(plan_.rows, source.row, &ResolvedRow::row);
    CHECK(row != plan_.rows.end(), "the reach of row {} is asked for, which does not run",
          source.row);
    int reach = 0;
    for (const ResolvedInput& input : row->inputs) reach = std::max(reach, ofInput(*row, input));
    return rows_[source.row] = reach;
  }

  int ofInput(const ResolvedRow& row, const ResolvedInput& input) {
    const int halo = row.description.input(input.port)->halo;
    const bool isPicture = input.source.type.texture && input.source.kind == Source::Kind::Output;
    if (!isPicture) return of(input.source);
    const SizeRelation size = sizes_.of(input.source);
    if (size.absolute != uvec2(0)) return 0;
    if (halo == kWholeImage) {
      whole_ = row.name + "." + input.port;
      return of(input.source);
    }
    double scale = 1;
    for (const float factor : size.scales) scale *= factor;
    return of(input.source) + static_cast<int>(std::ceil(halo / scale));
  }

  const Plan& plan_;
  SizeRelations sizes_;
  std::map<std::size_t, int> rows_;  // known so far, px of the output
  std::string whole_;
};

}  // namespace

Reach reachOf(const Plan& plan) {
  return Reaches(plan).run();
}

}  // namespace lucerna::graph
