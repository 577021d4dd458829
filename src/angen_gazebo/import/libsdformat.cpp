#include "import/libsdformat.h"

#include <console_bridge/console.h>

#include <mutex>
#include <sstream>

namespace angen::load {

namespace {

std::mutex& console_mutex() {
  static std::mutex mutex;
  return mutex;
}

bool is_needed(const sdf::ElementPtr& schema, const std::set<std::string>& names) {
  const std::string required = schema->GetRequired();
  return required == "1" || required == "+" || names.count(schema->GetName()) != 0;
}

sdf::ElementPtr pruned(const sdf::ElementPtr& schema, const std::set<std::string>& names) {
  sdf::ElementPtr kept(new sdf::Element());
  kept->SetName(schema->GetName());
  kept->SetRequired(schema->GetRequired());
  kept->SetCopyChildren(schema->GetCopyChildren());
  kept->SetReferenceSDF(schema->ReferenceSDF());
  for (const sdf::ParamPtr& attribute : schema->GetAttributes()) {
    kept->AddAttribute(attribute->GetKey(), attribute->GetTypeName(),
                       attribute->GetDefaultAsString(), attribute->GetRequired());
  }
  if (const sdf::ParamPtr value = schema->GetValue()) {
    kept->AddValue(value->GetTypeName(), value->GetDefaultAsString(), value->GetRequired(),
                   value->GetMinValueAsString().value_or(""),
                   value->GetMaxValueAsString().value_or(""));
  }
  for (std::size_t i = 0; i < schema->GetElementDescriptionCount(); ++i) {
    const sdf::ElementPtr child = schema->GetElementDescription(static_cast<unsigned>(i));
    if (is_needed(child, names)) kept->AddElementDescription(pruned(child, names));
  }
  return kept;
}

}  // namespace

void collect_names(const Element& element, std::set<std::string>& names) {
  names.insert(element.name);
  for (const Element& child : element.children) collect_names(child, names);
}

struct SilenceConsole::Impl : console_bridge::OutputHandler {
  std::lock_guard<std::mutex> lock{console_mutex()};
  std::ostringstream text;
  std::ostream* before = nullptr;

  void log(const std::string& line, console_bridge::LogLevel, const char*, int) override {
    text << line << '\n';
  }
};

SilenceConsole::SilenceConsole() : impl_(std::make_unique<Impl>()) {
  auto& stream = sdf::Console::Instance()->GetMsgStream();
  impl_->before = stream.GetStream();
  stream.SetStream(&impl_->text);
  console_bridge::useOutputHandler(impl_.get());
}

SilenceConsole::~SilenceConsole() {
  console_bridge::restorePreviousOutputHandler();
  sdf::Console::Instance()->GetMsgStream().SetStream(impl_->before);
}

std::string SilenceConsole::messages() const { return impl_->text.str(); }

// libsdformat copies an element's schema, with all that might be below it, for each element that it
// reads: a megabyte a link. It gets the part of the schema that a document uses.
sdf::SDFPtr empty_document(const std::set<std::string>& names) {
  static const sdf::SDFPtr schema = [] {
    sdf::SDFPtr all(new sdf::SDF());
    sdf::init(all);
    return all;
  }();
  sdf::SDFPtr fresh(new sdf::SDF());
  fresh->Root(pruned(schema->Root(), names));
  return fresh;
}

}  // namespace angen::load
