#include "record/json_line.h"

#include <rapidjson/document.h>
#include <rapidjson/error/en.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <charconv>

#include "core/random.h"
#include "record/fingerprint.h"

namespace angen::record {

namespace {

// The values of a command may be infinite or NaN; texts may hold any bytes.
constexpr unsigned kWriteFlags = rapidjson::kWriteNanAndInfFlag;
constexpr unsigned kParseFlags = rapidjson::kParseNumbersAsStringsFlag |
                                 rapidjson::kParseNanAndInfFlag | rapidjson::kParseIterativeFlag;
constexpr std::size_t kSumEnd = 26;  // bytes of the text of ends_with()

std::string ends_with(std::uint64_t sum) { return ",\"sum\":\"" + fingerprint_text(sum) + "\"}"; }

rapidjson::SizeType size_of(const std::string& text) {
  return static_cast<rapidjson::SizeType>(text.size());
}

}  // namespace

struct LineWriter::Impl {
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer, rapidjson::UTF8<>, rapidjson::UTF8<>,
                    rapidjson::CrtAllocator, kWriteFlags>
      json{buffer};
};

LineWriter::LineWriter() : impl_(std::make_unique<Impl>()) { impl_->json.StartObject(); }

LineWriter::~LineWriter() = default;

LineWriter& LineWriter::text(const char* key, const std::string& value) {
  impl_->json.Key(key);
  impl_->json.String(value.data(), size_of(value));
  return *this;
}

LineWriter& LineWriter::flag(const char* key, bool value) {
  impl_->json.Key(key);
  impl_->json.Bool(value);
  return *this;
}

LineWriter& LineWriter::whole(const char* key, std::uint64_t value) {
  impl_->json.Key(key);
  impl_->json.Uint64(value);
  return *this;
}

LineWriter& LineWriter::number(const char* key, double value) {
  impl_->json.Key(key);
  impl_->json.Double(value);
  return *this;
}

LineWriter& LineWriter::numbers(const char* key, const std::vector<double>& values) {
  impl_->json.Key(key);
  impl_->json.StartArray();
  for (const double value : values) impl_->json.Double(value);
  impl_->json.EndArray();
  return *this;
}

LineWriter& LineWriter::texts(const char* key, const std::vector<std::string>& values) {
  impl_->json.Key(key);
  impl_->json.StartArray();
  for (const std::string& value : values) impl_->json.String(value.data(), size_of(value));
  impl_->json.EndArray();
  return *this;
}

std::string LineWriter::done(std::uint64_t& sum) {
  std::string line(impl_->buffer.GetString(), impl_->buffer.GetSize());
  sum = hash_bytes(line, sum);
  return line + ends_with(sum) + "\n";
}

namespace {

/// Converts numbers itself: RapidJSON reads outside of a table for one with hundreds of zeros.
class Document : public rapidjson::Document {
 public:
  /// Empty if all of the line is JSON.
  rapidjson::ParseResult read(const std::string& line) {
    rapidjson::MemoryStream stream(line.data(), line.size());
    rapidjson::Reader reader;
    rapidjson::ParseResult result;
    const auto fill = [&](rapidjson::Document&) {
      result = reader.Parse<kParseFlags>(stream, *this);
      return !result.IsError();
    };
    Populate(fill);
    return result;
  }

  /// The reader calls this instead of the base's, which would make it a text.
  bool RawNumber(const char* text, rapidjson::SizeType length, bool /*copy*/) {
    const char* const end = text + length;
    std::uint64_t whole = 0;
    if (const auto done = std::from_chars(text, end, whole);
        done.ec == std::errc() && done.ptr == end) {
      return Uint64(whole);
    }
    double number = 0.0;
    const auto done = std::from_chars(text, end, number);
    return done.ec == std::errc() && done.ptr == end && Double(number);
  }
};

std::string reason(const rapidjson::ParseResult& wrong) {
  if (wrong.Code() == rapidjson::kParseErrorTermination) return "A number that no double can hold.";
  return rapidjson::GetParseError_En(wrong.Code());
}

}  // namespace

struct LineReader::Impl {
  const std::string& line;
  Source at;
  std::uint64_t byte;
  Document json{};
};

LineReader::LineReader(const std::string& line, const Source& at, std::uint64_t byte)
    : impl_(new Impl{line, at, byte}) {
  if (const rapidjson::ParseResult result = impl_->json.read(line); result.IsError()) {
    throw Error(at, "is damaged at byte " + std::to_string(byte + result.Offset()) +
                        " of the file: " + reason(result));
  }
  if (!impl_->json.IsObject()) fail("not a JSON object");
}

LineReader::~LineReader() = default;

void LineReader::check(std::uint64_t& sum) const {
  const std::string& line = impl_->line;
  if (line.size() < kSumEnd) fail("the line has no checksum");
  const std::size_t end = line.size() - kSumEnd;
  sum = hash_bytes(std::string_view(line).substr(0, end), sum);
  if (line.compare(end, kSumEnd, ends_with(sum)) != 0) {
    fail("its checksum is not that of this line and those before it");
  }
}

void LineReader::fail(const std::string& what) const {
  throw Error(impl_->at, "is damaged, the line that begins at byte " + std::to_string(impl_->byte) +
                             " of the file: " + what);
}

namespace {

/// The value of `key` if `is` finds it to be of the right type.
template <class Is>
const rapidjson::Value& value_of(const LineReader& reader, const rapidjson::Document& json,
                                 const char* key, const char* type, Is is) {
  const auto found = json.FindMember(key);
  if (found == json.MemberEnd() || !is(found->value)) {
    reader.fail("'" + std::string(key) + "' is missing, or not " + type);
  }
  return found->value;
}

template <class Is>
bool all_are(const rapidjson::Value& value, Is is) {
  if (!value.IsArray()) return false;
  for (const rapidjson::Value& part : value.GetArray()) {
    if (!is(part)) return false;
  }
  return true;
}

bool is_number(const rapidjson::Value& value) { return value.IsNumber(); }
bool is_text(const rapidjson::Value& value) { return value.IsString(); }

std::string text_of(const rapidjson::Value& value) {
  return {value.GetString(), value.GetStringLength()};
}

}  // namespace

bool LineReader::has(const char* key) const { return impl_->json.HasMember(key); }

std::string LineReader::text(const char* key) const {
  return text_of(value_of(*this, impl_->json, key, "a text", is_text));
}

bool LineReader::flag(const char* key) const {
  return value_of(*this, impl_->json, key, "true or false",
                  [](const auto& v) { return v.IsBool(); })
      .GetBool();
}

std::uint64_t LineReader::whole(const char* key) const {
  return value_of(*this, impl_->json, key, "a whole number of at least 0",
                  [](const auto& v) { return v.IsUint64(); })
      .GetUint64();
}

double LineReader::number(const char* key) const {
  return value_of(*this, impl_->json, key, "a number", is_number).GetDouble();
}

std::vector<double> LineReader::numbers(const char* key) const {
  const auto& list = value_of(*this, impl_->json, key, "a list of numbers",
                              [](const auto& v) { return all_are(v, is_number); });
  std::vector<double> values;
  for (const rapidjson::Value& value : list.GetArray()) values.push_back(value.GetDouble());
  return values;
}

std::vector<std::string> LineReader::texts(const char* key) const {
  const auto& list = value_of(*this, impl_->json, key, "a list of texts",
                              [](const auto& v) { return all_are(v, is_text); });
  std::vector<std::string> values;
  for (const rapidjson::Value& value : list.GetArray()) values.push_back(text_of(value));
  return values;
}

}  // namespace angen::record
