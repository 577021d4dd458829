#include "document/xml.h"

#include "fuzz/targets.h"

namespace angen::fuzz {

void xml(const std::string& input) {
  Element root;
  try {
    root = load::parse_xml(input, "fuzz.xml");
  } catch (const Error&) {
    return;
  }
  const std::string printed = load::print_xml(root);
  std::string again;
  answered([&] { again = load::print_xml(load::parse_xml(printed, "printed.xml")); });
  require(again == printed, "printed XML reads the same");
}

}  // namespace angen::fuzz
