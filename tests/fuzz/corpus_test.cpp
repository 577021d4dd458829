#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/targets.h"

namespace angen::fuzz {
namespace {

namespace fs = std::filesystem;

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
    std::ifstream stream(file, std::ios::binary);
    GetParam().run({std::istreambuf_iterator<char>(stream), {}});
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(targets()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace angen::fuzz
