#include "core/stopwatch.h"

#include <gtest/gtest.h>

namespace angen {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

Nanoseconds wall = 0;
Nanoseconds cpu = 0;

void work(Nanoseconds time) {
  wall += time;
  cpu += time;
}
void be_away(Nanoseconds time) { wall += time; }

Stopwatch stopwatch() {
  wall = kSecond;
  cpu = 0;
  return Stopwatch({[] { return wall; }, [] { return cpu; }});
}

TEST(Stopwatch, EachLapIsTheTimeSinceTheOneBefore) {
  Stopwatch watch = stopwatch();
  watch.start(true);
  work(300);
  EXPECT_EQ(watch.lap(), 300);
  work(20);
  EXPECT_EQ(watch.lap(), 20);
  EXPECT_EQ(watch.lap(), 0);
  work(3 * kMillisecond);
  EXPECT_EQ(watch.lap(), 3 * kMillisecond);
}

TEST(Stopwatch, WhatGoesByBetweenALapAndAStartIsNobodys) {
  Stopwatch watch = stopwatch();
  watch.start(true);
  work(100);
  EXPECT_EQ(watch.lap(), 100);
  work(7000);
  be_away(kSecond);
  watch.start(true);
  work(200'000);
  EXPECT_EQ(watch.lap(), 200'000);
}

TEST(Stopwatch, TimeInWhichTheThreadWasAwayIsNoCost) {
  Stopwatch watch = stopwatch();
  watch.start(true);
  for (int i = 0; i < 1000; ++i) {
    work(1000);
    EXPECT_EQ(watch.lap(), 1000);
  }
  work(700);
  be_away(4 * kMillisecond);
  EXPECT_EQ(watch.lap(), 700);
  be_away(4 * kMillisecond);
  work(90'000);
  EXPECT_EQ(watch.lap(), 90'000);
}

TEST(Stopwatch, OneThatDoesNotRunReadsNoClock) {
  Stopwatch watch({nullptr, nullptr});
  watch.start(false);
  EXPECT_EQ(watch.lap(), 0);
}

}  // namespace
}  // namespace angen
