// angen_describe LIBRARY.so ...: writes the kinds of a library to LIBRARY.json beside it.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "plugin/json.h"

namespace {

void write_description(const std::string& library) {
  const std::string suffix = ".so";
  if (library.size() <= suffix.size() ||
      library.compare(library.size() - suffix.size(), suffix.size(), suffix) != 0) {
    throw angen::Error(library + " is not a shared library, must end with .so");
  }
  angen::Catalog catalog(true);  // the caller has named the library
  const std::string text = to_json(angen::describe(catalog, library));
  const std::string path = library.substr(0, library.size() - suffix.size()) + ".json";
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) throw angen::Error(path + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) write_description(argv[i]);
    return EXIT_SUCCESS;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "angen_describe: %s\n", problem.what());
    return EXIT_FAILURE;
  }
}
