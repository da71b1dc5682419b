// DIR/work/bake.json: what was asked for, so that shards, later runs and the merge all do the same.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bake/plan.hpp"
#include "core/result.hpp"

namespace lucerna::bake {

struct BakeOrder {
  std::string scene;       // as scene::loadScene() takes it; a file by its absolute path
  std::uint64_t plan = 0;  // Plan::hash
  std::string processor;   // rayInstructionSet() of whoever bakes
  BakeSettings settings;
};

BakeOrder orderOf(const Plan& plan, const std::string& scene);

// Settings as one JSON object's text.
std::string settingsText(const BakeSettings& settings);

// Errors (ErrorKind::Input): every fault, one a line.
Result<BakeSettings> settingsFrom(std::string_view text, const std::string& name);

// "--density is 10 there, 20 here"; empty: they are the same.
std::string differences(const BakeSettings& there, const BakeSettings& here);

// Of `there`, of another bake, the copies that `here` does not ask for, where all else is the same.
std::vector<Encoding> furtherCopies(const std::string& there, const BakeSettings& here);
// "rgb9e5, png"
std::string copiesText(std::span<const Encoding> copies);

// Whether `there`, of another bake, says the same but for copies that it does not ask for.
bool lacksCopiesAlone(const std::string& there, const BakeSettings& here);

std::string toJson(const BakeOrder& order);
// Errors (ErrorKind::Input): every fault, one a line.
Result<BakeOrder> orderFrom(std::string_view text, const std::string& name);

// ErrorKind::Input: there is none, or it is damaged.
Result<BakeOrder> readOrder(const std::filesystem::path& folder);

// Writes it if there is none. ErrorKind::Usage if there is one of other settings, of a scene that
// was another then, or of another kind of processor; it names the flags that differ. The same scene
// may lie elsewhere.
Status keepOrder(const std::filesystem::path& folder, const BakeOrder& order);

}  // namespace lucerna::bake
