#include "graph/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "graph/size_relation.hpp"

namespace lucerna::graph {
namespace {

bool isPicture(const Source& source, SizeRelations& sizes) {
  return source.kind == Source::Kind::Output && source.type.texture &&
         sizes.of(source).absolute == uvec2(0);
}

class Reaches {
 public:
  explicit Reaches(const Plan& plan) : plan_(plan), sizes_(plan) {}

  Reach run() {
    // As long as a way without circles at most; whoever goes round one with a halo reads
    // everywhere.
    for (std::size_t i = 0; i < plan_.rows.size(); ++i) lengthen();
    result_.pixels = of(plan_.output);
    for (const Source& kept : plan_.kept) result_.pixels = std::max(result_.pixels, of(kept));
    for (const ResolvedRow& row : plan_.rows) {
      if (row.culled) continue;
      if (row.description.frequency != Frequency::PerView) checkOutputs(row);
      for (const ResolvedInput& input : row.inputs) checkInput(row, input);
    }
    return result_;
  }

 private:
  // Every row's reach by one step on the way.
  void lengthen() {
    for (const ResolvedRow& row : plan_.rows)
      for (const ResolvedInput& input : row.inputs)
        if (!row.culled) rows_[row.row] = std::max(rows_[row.row], ofInput(row, input));
  }

  int of(const Source& source) {
    return source.kind == Source::Kind::Output ? rows_[source.row] : 0;
  }

  int ofInput(const ResolvedRow& row, const ResolvedInput& input) {
    const int halo = haloOf(row, input);
    if (halo <= 0 || !isPicture(input.source, sizes_)) return of(input.source);
    double scale = 1;
    for (const float factor : sizes_.of(input.source).scales) scale *= factor;
    return of(input.source) + static_cast<int>(std::ceil(halo / scale));
  }

  void checkInput(const ResolvedRow& row, const ResolvedInput& input) {
    const Source& source = input.source;
    if (source.kind != Source::Kind::Output || !source.type.texture) return;
    if (!isPicture(source, sizes_)) return checkMaker(source);
    const int halo = haloOf(row, input);
    if (halo == kWholeImage)
      needsWhole(row, input.port, "no halo says how far around a pixel it reads");
    else if (halo > 0 && dependsOn(source, row.row))
      needsWhole(row, input.port,
                 fmt::format("its halo of {} px adds up frame by frame, as what it reads "
                             "follows from its own last frame",
                             halo));
  }

  // Of a row that runs once for all tiles.
  void checkOutputs(const ResolvedRow& row) {
    for (const PortDescription& port : row.description.ports) {
      const Source made{.kind = Source::Kind::Output,
                        .row = row.row,
                        .port = port.name,
                        .type = port.type,
                        .size = {}};
      if (port.direction != Direction::In && isPicture(made, sizes_))
        needsWhole(row, port.name, "it is made once for all tiles");
    }
  }

  // Of a value that has a size of its own, whatever the output's: each of its pixels may follow
  // from any pixel of what it is made from.
  void checkMaker(const Source& made) {
    const ResolvedRow& maker = rowOf(made);
    for (const ResolvedInput& input : maker.inputs)
      if (isOfATile(input.source))
        needsWhole(maker, input.port,
                   fmt::format("'{}', which is made from it, has a size of its own", made.port));
  }

  void needsWhole(const ResolvedRow& row, const std::string& port, std::string why) {
    result_.whole = row.name + "." + port;
    result_.why = std::move(why);
  }

  static int haloOf(const ResolvedRow& row, const ResolvedInput& input) {
    return row.description.input(input.port)->halo;
  }

  // Whether it is another value in each tile: a picture, the view, or what follows from them.
  bool isOfATile(const Source& source) {
    std::set<std::size_t> seen;
    return anyBehind(source, seen,
                     [&](const Source& s) { return s.perView || isPicture(s, sizes_); });
  }

  bool dependsOn(const Source& source, std::size_t row) const {
    std::set<std::size_t> seen;
    return anyBehind(source, seen, [&](const Source& s) {
      return s.kind == Source::Kind::Output && s.row == row;
    });
  }

  // Among the value itself and all that it is made from.
  template <typename Predicate>
  bool anyBehind(const Source& source, std::set<std::size_t>& seen, const Predicate& wanted) const {
    if (wanted(source)) return true;
    if (source.kind != Source::Kind::Output || !seen.insert(source.row).second) return false;
    return std::ranges::any_of(rowOf(source).inputs, [&](const ResolvedInput& input) {
      return anyBehind(input.source, seen, wanted);
    });
  }

  const ResolvedRow& rowOf(const Source& source) const {
    const auto row = std::ranges::find(plan_.rows, source.row, &ResolvedRow::row);
    CHECK(row != plan_.rows.end(), "the reach of row {} is asked for, which does not run",
          source.row);
    return *row;
  }

  const Plan& plan_;
  SizeRelations sizes_;
  std::map<std::size_t, int> rows_;  // found so far, px of the output
  Reach result_;
};

}  // namespace

Reach reachOf(const Plan& plan) {
  return Reaches(plan).run();
}

}  // namespace lucerna::graph
