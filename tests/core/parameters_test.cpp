// What a table says is taken as it stands or refused with its place, what it is, and what would be
// right; nothing is passed over.
#include "core/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/infinity.h"

namespace portalens::test {
namespace {

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() : file_(std::make_shared<const std::string>("scene.toml")) {
    table_ = {"sphere", {file_, 1}, {}};
  }

  Value at(int line, decltype(Value::data) data) { return {std::move(data), {file_, line}}; }
  void set(const std::string& key, decltype(Value::data) data) {
    table_.set(key, at(12, std::move(data)));
  }
  Value::List list(std::initializer_list<double> numbers) {
    Value::List result;
    for (const double number : numbers) result.push_back(at(12, number));
    return result;
  }
  std::string told() {
    try {
      faults_.raise();
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  std::shared_ptr<const std::string> file_;
  Table table_;
  Faults faults_;
};

TEST_F(ParametersTest, AWholeNumberServesWhereANumberIsWanted) {
  set("radius", std::int64_t{3});
  EXPECT_EQ(Parameters(table_, faults_).number("radius", positive), 3.0);
  EXPECT_EQ(told(), "");
}

TEST_F(ParametersTest, AWrongTypeIsToldWithPlaceAndRemedy) {
  set("radius", std::string("big"));
  Parameters(table_, faults_).number("radius", positive);
  EXPECT_EQ(told(), "scene.toml:12: 'radius' is a string; give a number greater than 0");
}

TEST_F(ParametersTest, ANumberThatIsNotFiniteIsRefusedEverywhere) {
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    Faults faults;
    set("number", bad);
    set("integer", bad);
    set("triple", list({0.0, bad, 0.0}));
    set("either", bad);
    set("points", Value::List{at(12, list({0.0, 0.0, bad}))});
    Parameters parameters(table_, faults);
    EXPECT_TRUE(std::isfinite(parameters.number("number")));
    EXPECT_EQ(parameters.integer("integer", 0, 9), 0);
    for (const double x : parameters.triple("triple")) EXPECT_TRUE(std::isfinite(x));
    for (const double x : parameters.number_or_triple("either")) EXPECT_TRUE(std::isfinite(x));
    EXPECT_TRUE(parameters.points("points", 1, 1).empty());
    EXPECT_EQ(faults.size(), 5U);
  }
}

TEST_F(ParametersTest, BoundsAreHeldAndOpenOnesExcludeTheirEnd) {
  set("zero", 0.0);
  set("one", 1.0);
  set("two", 2.0);
  Parameters parameters(table_, faults_);
  EXPECT_EQ(parameters.number("zero", non_negative), 0.0);
  EXPECT_EQ(parameters.number("one", unit_interval), 1.0);
  EXPECT_TRUE(faults_.empty());
  EXPECT_GT(parameters.number("zero", positive), 0.0);
  EXPECT_LE(parameters.number("two", unit_interval), 1.0);
  EXPECT_EQ(faults_.size(), 2U);
}

TEST_F(ParametersTest, AfterAFaultTheFallbackStandsIn) {
  set("radius", true);
  Parameters parameters(table_, faults_);
  EXPECT_EQ(parameters.number("radius", positive, 7.0), 7.0);
  EXPECT_EQ(parameters.number("other", positive, 8.0), 8.0);
  EXPECT_EQ(faults_.size(), 1U);
}

TEST_F(ParametersTest, AMissingKeyIsToldAtTheTable) {
  Parameters(table_, faults_).number("radius", positive);
  EXPECT_EQ(told(), "scene.toml:1: sphere has no 'radius'; give it a number greater than 0");
}

TEST_F(ParametersTest, AFractionIsNoWholeNumber) {
  set("samples", 2.5);
  Parameters(table_, faults_).integer("samples", 1, 100);
  EXPECT_EQ(told(), "scene.toml:12: 'samples' is 2.5; give a whole number from 1 to 100");
}

TEST_F(ParametersTest, ATextWithControlCharactersIsRefused) {
  set("name", std::string("a\nb"));
  Parameters(table_, faults_).text("name");
  EXPECT_NE(told().find("control character"), std::string::npos);
}

TEST_F(ParametersTest, AnUnknownChoiceListsTheKnownOnes) {
  constexpr std::array<std::string_view, 2> known{"euler", "rk4"};
  set("integrator", std::string("eular"));
  EXPECT_EQ(Parameters(table_, faults_).choice("integrator", known), "euler");
  EXPECT_NE(told().find("did you mean euler?"), std::string::npos);
  EXPECT_NE(told().find("euler, rk4"), std::string::npos);
}

TEST_F(ParametersTest, AListOfTheWrongLengthIsNoPoint) {
  set("center", list({1.0, 2.0}));
  set("vertices", list({1.0, 2.0, 3.0}));
  Parameters parameters(table_, faults_);
  parameters.triple("center");
  parameters.points("vertices", 3, 4);
  EXPECT_NE(told().find("'center' is a list of 2"), std::string::npos);
  EXPECT_NE(told().find("'vertices' contains"), std::string::npos);
}

TEST_F(ParametersTest, EveryKeyThatNobodyAskedForIsTold) {
  set("max_depth", std::int64_t{8});
  set("zzzzzzz", std::int64_t{8});
  Parameters parameters(table_, faults_);
  parameters.integer("max_bounces", 0, 100, 8);
  parameters.finish();
  EXPECT_EQ(told(),
            "scene.toml:12: unknown key 'max_depth'; did you mean max_bounces?\n"
            "scene.toml:12: unknown key 'zzzzzzz'; known are max_bounces");
}

TEST_F(ParametersTest, AskingWhetherAKeyStandsMakesItKnown) {
  set("horizon", true);
  Parameters parameters(table_, faults_);
  EXPECT_TRUE(parameters.has("horizon"));
  EXPECT_FALSE(parameters.has("mass"));
  parameters.finish();
  EXPECT_TRUE(faults_.empty());
}

TEST(Table, SettingAKeyTwiceKeepsTheLastValue) {
  Table table;
  table.set("a", {1.0, {}});
  table.set("a", {2.0, {}});
  ASSERT_EQ(table.entries.size(), 1U);
  EXPECT_EQ(std::get<double>(table.find("a")->data), 2.0);
}

}  // namespace
}  // namespace portalens::test
