#include "plugin/summary.h"

#include <gtest/gtest.h>

#include <limits>

namespace angen {
namespace {

TEST(Summary, ShowsWhatTheKindShowsWithUnits) {
  const Kind kind = Kind("mat", "")
                        .flag("pressed", "")
                        .alarm("PRESSED", "free")
                        .number("load", "kg", "")
                        .shown(1)
                        .number("threshold", "kg", "")
                        .number("charge", "1", "")
                        .shown_as_percent()
                        .texts("ids", "")
                        .shown();
  Reading reading;
  reading.set("pressed", true);
  reading.set("load", 71.26);
  reading.set("threshold", 10.0);
  reading.set("charge", 0.256);
  reading.set("ids", std::vector<std::string>{"a", "b"});
  EXPECT_EQ(summary(kind, reading), "PRESSED  71.3 kg  26 %  a b");
  EXPECT_TRUE(alarms(kind, reading));
  reading.set("pressed", false);
  reading.set("load", -0.01);
  reading.set("ids", std::vector<std::string>{});
  EXPECT_EQ(summary(kind, reading), "free  0.0 kg  26 %  none");
  EXPECT_FALSE(alarms(kind, reading));
}

TEST(Summary, NamesNumbers) {
  const Kind kind =
      Kind("climate", "").texts("names", "").numbers("warmth", "°C", "").shown_by_name("names", 1);
  Reading reading;
  reading.set("warmth", std::vector<double>{20.04, -0.01});
  EXPECT_EQ(summary(kind, reading), "20.0 0.0 °C");
  reading.set("names", std::vector<std::string>{"kitchen", "hall"});
  EXPECT_EQ(summary(kind, reading), "kitchen 20.0, hall 0.0 °C");
}

TEST(Summary, OfAValueThatThereIsNotIsADash) {
  const Kind kind = Kind("air", "")
                        .number("temperature", "°C", "")
                        .shown(1)
                        .number("charge", "1", "")
                        .shown_as_percent()
                        .numbers("rooms", "°C", "")
                        .shown(1);
  const double none = std::numeric_limits<double>::quiet_NaN();
  Reading reading;
  reading.set("temperature", none);
  reading.set("charge", -none);
  reading.set("rooms", std::vector<double>{20.0, none});
  EXPECT_EQ(summary(kind, reading), "–  –  20.0 – °C");
}

TEST(Summary, OfAKindThatShowsNothingIsEveryField) {
  Reading reading;
  reading.set("count", 3);
  reading.set("far", std::numeric_limits<double>::infinity());
  reading.set("mode", Choice{1, "OPEN"});
  EXPECT_EQ(summary(Kind("x", ""), reading), "count=3  far=inf  mode=OPEN");
}

}  // namespace
}  // namespace angen
