#include "sim/rota.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

Rhythm rhythm(Nanoseconds start, Nanoseconds sample, Nanoseconds publish) {
  Rhythm made;
  made.start = start;
  made.sample = sample;
  made.publish = publish;
  return made;
}

using Sensors = std::vector<std::uint32_t>;

TEST(Rota, GroupsThoseWhoseLooksFallOnTheSameTicks) {
  Rota rota;
  rota.assign({rhythm(0, 100 * kMs, 100 * kMs), rhythm(0, 10 * kMs, 100 * kMs),
               rhythm(300 * kMs, 100 * kMs, 100 * kMs), rhythm(350 * kMs, 100 * kMs, 100 * kMs),
               rhythm(0, 100 * kMs, 200 * kMs)},
              400 * kMs);
  ASSERT_EQ(rota.groups().size(), 4U);
  EXPECT_EQ(rota.groups()[0].awake, (Sensors{0, 2}));
  EXPECT_EQ(rota.groups()[1].awake, (Sensors{1}));
  EXPECT_EQ(rota.groups()[2].awake, (Sensors{3}));
  EXPECT_EQ(rota.groups()[3].awake, (Sensors{4}));
  EXPECT_EQ(rota.collect(409 * kMs), Sensors{});
  EXPECT_EQ(rota.collect(410 * kMs), Sensors{1});
  EXPECT_EQ(rota.collect(411 * kMs), Sensors{});
  EXPECT_EQ(rota.collect(450 * kMs), (Sensors{1, 2}));
  EXPECT_EQ(rota.collect(500 * kMs), (Sensors{1, 0, 3}));
  EXPECT_TRUE(rota.groups()[1].publishes(500 * kMs));
  EXPECT_FALSE(rota.groups()[1].publishes(510 * kMs));
  EXPECT_FALSE(rota.groups()[3].publishes(500 * kMs));
  rota.requeue(1000 * kMs);
  EXPECT_EQ(rota.collect(1009 * kMs), Sensors{});
  EXPECT_EQ(rota.collect(1010 * kMs), Sensors{1});
}

TEST(Rota, CalmSensorsWaitApartUntilTheyAreRoused) {
  Rota rota;
  rota.assign(std::vector<Rhythm>(5, rhythm(0, kMs, kMs)), 0);
  Rota::Group& group = rota.group(0);
  for (const std::uint32_t sensor : {3U, 1U}) rota.calm(sensor);
  EXPECT_TRUE(rota.is_calm(1));
  EXPECT_EQ(group.awake.size(), 5U);  // until the shift
  rota.shift(group);
  EXPECT_EQ(group.awake, (Sensors{0, 2, 4}));
  EXPECT_EQ(group.calm, (Sensors{1, 3}));
  rota.rouse(3);
  rota.calm(0);
  rota.shift(group);
  EXPECT_EQ(group.awake, (Sensors{2, 3, 4}));
  EXPECT_EQ(group.calm, (Sensors{0, 1}));
  EXPECT_FALSE(rota.is_calm(3));
}

}  // namespace
}  // namespace angen::sim
