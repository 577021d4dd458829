#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "fuzz/targets.h"

namespace angen::fuzz {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every input that was once a finding, and some of each sort of right ones.
class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, IsAcceptedOrRejected) {
  std::vector<fs::path> files;
  const fs::path folder = fs::path(ANGEN_TESTS_DIR) / "fuzz/corpus" / GetParam().name;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path());
  }
  ASSERT_FALSE(files.empty()) << folder;
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    GetParam().run(text_of(file));
  }
}

// ./angen fuzz begins with all models of worlds/.
TEST(Models, AreAccepted) {
  for (const char* name : {"bathroom_door", "ceiling_lamp", "cup", "optical_switch", "pir", "plant",
                           "stove", "weighing_table"}) {
    SCOPED_TRACE(name);
    const std::string model = text_of(fs::path(ANGEN_WORLDS_DIR) / "models" / name / "model.sdf");
    ASSERT_FALSE(model.empty());
    urdf(model);
    const std::string begins =
        std::regex_replace(model, std::regex("<sdf[^>]*>"), "$&<world name='w'>");
    sim(std::regex_replace(begins, std::regex("</sdf>"), "</world></sdf>"));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(targets()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace angen::fuzz
