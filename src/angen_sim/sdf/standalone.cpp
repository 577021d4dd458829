// Texts that stand alone: which files they still need, and where these are.
#include <functional>
#include <set>

#include "document/search.h"
#include "document/xml.h"
#include "sdf/load.h"

namespace angen::load {

namespace {

void each_file_uri(Element& element, const std::function<void(Element&)>& visit) {
  const bool reads = element.name == "mesh" || element.name == "heightmap" ||
                     element.name == "image" || element.name == "angen:ies";
  for (Element& child : element.children) {
    if (reads && child.name == "uri") {
      visit(child);
    } else if (child.name != "plugin") {
      each_file_uri(child, visit);
    }
  }
}

}  // namespace

std::vector<UsedFile> files_of(const std::string& xml, const SearchPaths& paths) {
  Session session{paths};
  Element root = parse_xml(xml, "(text)");
  std::vector<UsedFile> files;
  std::set<std::string> seen;
  each_file_uri(root, [&](const Element& uri) {
    if (seen.insert(uri.text).second) {
      files.push_back({uri.text, find_uri(uri.text, "", session).value_or("")});
    }
  });
  return files;
}

std::string with_files(const std::string& xml, const std::vector<UsedFile>& files) {
  Element root = parse_xml(xml, "(text)");
  each_file_uri(root, [&](Element& uri) {
    for (const UsedFile& file : files) {
      if (uri.text != file.uri) continue;
      uri.text = "file://" + file.path;
      return;
    }
  });
  return print_xml(root);
}

std::string world_around(const desc::Model& model) {
  return "<sdf version=\"1.9\"><world name=\"alone\">\n" +
         (model.expanded_xml.empty() ? model.xml : model.expanded_xml) + "</world></sdf>\n";
}

}  // namespace angen::load
