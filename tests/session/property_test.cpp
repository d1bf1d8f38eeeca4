#include "ostia/session/property.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ostia::session {
namespace {

using ::testing::ElementsAre;

TEST(Property, TellsAChangeOnceAndNothingWhereTheValueIsTheSame) {
  Property<std::string> name("LAD");
  std::vector<std::string> told;
  const Subscription kept = name.observe([&](const std::string& value) { told.push_back(value); });
  EXPECT_FALSE(name.set("LAD"));
  EXPECT_TRUE(name.set("LCX"));
  EXPECT_EQ(name.get(), "LCX");
  EXPECT_THAT(told, ElementsAre("LCX"));
}

TEST(Property, ARangeClampsAndTakesToTheNearestStep) {
  Property<double> angle(0.0, Range<double>{0.0, 1.0, 0.1});
  EXPECT_TRUE(angle.set(0.34));
  EXPECT_DOUBLE_EQ(angle.get(), 0.3);
  EXPECT_TRUE(angle.set(7.0));
  EXPECT_EQ(angle.get(), 1.0);  // ten steps of 0.1, and not a hair more
  EXPECT_FALSE(angle.set(1.04));
  EXPECT_FALSE(angle.set(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(angle.set(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(angle.get(), 0.0);

  Property<int> slab(3, Range<int>{1, 10, 2});
  EXPECT_TRUE(slab.set(100));
  EXPECT_EQ(slab.get(), 9);  // 1, 3, ..., 9: ten is no step
  constexpr int kLeast = std::numeric_limits<int>::min(), kMost = std::numeric_limits<int>::max();
  Property<int> any(0, Range<int>{kLeast, kMost, 1});
  EXPECT_TRUE(any.set(kMost));
  EXPECT_EQ(any.get(), kMost);
}

TEST(Property, ARangeWithoutStepsKeepsTheValue) {
  Property<double> position(0.0, Range<double>{-1.0, 1.0, 0.0});
  EXPECT_TRUE(position.set(0.123456789));
  EXPECT_EQ(position.get(), 0.123456789);
}

TEST(Property, OnlyAChoiceIsTaken) {
  enum class Mode { straightened, stretched, projected };
  Property<Mode> mode(Mode::straightened, Property<Mode>::Choices{{Mode::straightened, "Straightened"},
                                                                  {Mode::stretched, "Stretched"}});
  EXPECT_FALSE(mode.set(Mode::projected));
  EXPECT_EQ(mode.get(), Mode::straightened);
  EXPECT_TRUE(mode.set(Mode::stretched));
  ASSERT_NE(mode.choices(), nullptr);
  EXPECT_EQ((*mode.choices())[1].name, "Stretched");
  EXPECT_EQ(mode.range(), nullptr);
}

TEST(Property, RefusesDomainsWithoutAPlace) {
  using Number = Property<double>;
  using Text = Property<std::string>;
  EXPECT_THROW(Number(0.0, Range<double>{1.0, 0.0, 0.0}), InvalidInput);
  EXPECT_THROW(Number(0.0, Range<double>{0.0, 1.0, -0.1}), InvalidInput);
  EXPECT_THROW(Number(0.0, Range<double>{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}), InvalidInput);
  EXPECT_THROW(Number(std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  EXPECT_THROW(Text("a", Text::Choices{}), InvalidInput);
  EXPECT_THROW(Text("a", Text::Choices{{"b", "B"}}), InvalidInput);
  EXPECT_THROW(Text("a", Range<std::string>{"a", "b", ""}), InvalidInput);
  Number kept(0.5);
  EXPECT_THROW(kept.set_domain(Range<double>{1.0, 0.0, 0.0}), InvalidInput);
  EXPECT_EQ(kept.get(), 0.5);
}

TEST(Property, ANewDomainIsToldBeforeTheValueThatItMoved) {
  Property<double> abscissa(80.0, Range<double>{0.0, 100.0, 0.0});
  std::vector<std::string> told;
  const Subscription value = abscissa.observe([&](double now) { told.push_back(std::to_string(now)); });
  const Subscription domain = abscissa.observe_domain([&] { told.push_back("domain"); });
  EXPECT_TRUE(abscissa.set_domain(Range<double>{0.0, 50.0, 0.0}));
  EXPECT_FALSE(abscissa.set_domain(Range<double>{0.0, 60.0, 0.0}));
  EXPECT_THAT(told, ElementsAre("domain", std::to_string(50.0), "domain"));
}

TEST(Property, ADroppedSubscriptionIsSilent) {
  Property<int> count(0);
  int calls = 0;
  {
    const Subscription scoped = count.observe([&](int) { ++calls; });
    count.set(1);
  }
  count.set(2);
  EXPECT_EQ(calls, 1);
  Subscription first = count.observe([&](int) { ++calls; });
  first = count.observe([&](int) { calls += 10; });  // the former is dropped
  count.set(3);
  EXPECT_EQ(calls, 11);
}

TEST(Property, AnObserverMayDropItselfAndOthersWhileTold) {
  Property<int> count(0);
  std::vector<std::string> told;
  Subscription self, other;
  const std::string alive(100, 'x');  // what the dropped observer holds is still read after the drop
  self = count.observe([&, alive](int) {
    self.drop();
    other.drop();
    told.push_back(alive);
  });
  other = count.observe([&](int) { told.push_back("other"); });
  const Subscription last = count.observe([&](int) { told.push_back("last"); });
  count.set(1);
  EXPECT_THAT(told, ElementsAre(alive, "last"));
  EXPECT_FALSE(self.active());
  count.set(2);
  EXPECT_THAT(told, ElementsAre(alive, "last", "last"));
}

TEST(Property, AnObserverThatComesWhileToldIsToldTheNextTime) {
  Property<int> count(0);
  std::vector<Subscription> late;
  int calls = 0;
  const Subscription kept = count.observe([&](int) { late.push_back(count.observe([&](int) { ++calls; })); });
  count.set(1);
  EXPECT_EQ(calls, 0);
  count.set(2);
  EXPECT_EQ(calls, 1);
}

TEST(Property, AllSeeTheNewestValueLastWhereAnObserverSetsIt) {
  Property<int> even(0);
  std::vector<int> before, after;
  const Subscription a = even.observe([&](int value) { before.push_back(value); });
  const Subscription b = even.observe([&](int value) { even.set(value + value % 2); });
  const Subscription c = even.observe([&](int value) { after.push_back(value); });
  even.set(3);
  EXPECT_EQ(even.get(), 4);
  EXPECT_THAT(before, ElementsAre(3, 4));
  EXPECT_THAT(after, ElementsAre(4));
}

TEST(Property, TwoPropertiesMayFollowEachOther) {
  Property<double> mm(0.0), cm(0.0);
  const Subscription a = mm.observe([&](double value) { cm.set(value / 10.0); });
  const Subscription b = cm.observe([&](double value) { mm.set(value * 10.0); });
  mm.set(25.0);
  EXPECT_EQ(cm.get(), 2.5);
  cm.set(3.0);
  EXPECT_EQ(mm.get(), 30.0);
}

TEST(Property, ObserversThatNeverAgreeAreStopped) {
  Property<int> count(0);
  Subscription restless = count.observe([&](int value) { count.set(value + 1); });
  EXPECT_THROW(count.set(1), std::logic_error);
  restless.drop();
  int told = 0;
  const Subscription kept = count.observe([&](int value) { told = value; });
  EXPECT_TRUE(count.set(-5));  // it works again
  EXPECT_EQ(told, -5);
}

TEST(Property, WhatAnObserverThrowsReachesTheSetter) {
  Property<int> count(0);
  Subscription thrower = count.observe([](int) { throw InvalidInput("no"); });
  EXPECT_THROW(count.set(1), InvalidInput);
  EXPECT_EQ(count.get(), 1);
  thrower.drop();
  EXPECT_TRUE(count.set(2));
}

TEST(Property, MayGoWhileItIsTold) {
  auto count = std::make_unique<Property<int>>(0);
  int calls = 0;
  Subscription taker = count->observe([&](int value) {
    ++calls;
    count.reset();
    EXPECT_EQ(value, 7);
  });
  const Subscription never = count->observe([&](int) { calls += 10; });
  Property<int>& there = *count;
  EXPECT_TRUE(there.set(7));
  EXPECT_EQ(calls, 1);
  taker.drop();  // after what it watched
}

}  // namespace
}  // namespace ostia::session
