#include "loading/description_search.h"

#include <gtest/gtest.h>

#include <map>

namespace concave_distance::description_search_test {
namespace {

using Parameters = std::map<std::string, std::string>;

std::optional<FoundDescription> search(const Parameters& parameters, const std::string& name,
                                       const std::string& space = "/arm/node") {
  return searchDescription(space, name, [&](const std::string& key) {
    const auto found = parameters.find(key);
    return found == parameters.end() ? std::nullopt : std::optional<std::string>(found->second);
  });
}

std::string keyOf(const std::optional<FoundDescription>& found) {
  return found ? found->key : "none";
}

TEST(DescriptionSearch, TheNodesOwnParameterThatNamesTheDescriptionIsNotTheDescription) {
  const Parameters parameters = {{"/node/robot_description", "robot_description"},
                                 {"/robot_description", "<robot/>"}};
  const auto found = search(parameters, "robot_description", "/node");
  EXPECT_EQ(keyOf(found), "/robot_description");
  EXPECT_TRUE(found->is_xml);
}

TEST(DescriptionSearch, ADescriptionInThePrivateNamespaceIsTheNearest) {
  EXPECT_EQ(keyOf(search({{"/arm/node/robot_description", "<robot/>"}, {"/robot_description", "<robot/>"}},
                         "robot_description")),
            "/arm/node/robot_description");
}

TEST(DescriptionSearch, GoesUpwardsThroughEveryNamespace) {
  EXPECT_EQ(keyOf(search({{"/arm/urdf", "<robot/>"}, {"/urdf", "<robot/>"}}, "urdf")), "/arm/urdf");
  EXPECT_EQ(keyOf(search({{"/urdf", "<robot/>"}}, "urdf")), "/urdf");
  EXPECT_EQ(keyOf(search({{"/left/urdf", "<robot/>"}}, "left/urdf")), "/left/urdf");
  EXPECT_EQ(keyOf(search({{"/other/urdf", "<robot/>"}}, "urdf")), "none");
}

TEST(DescriptionSearch, AnAbsoluteNameIsReadAsItIs) {
  EXPECT_EQ(keyOf(search({{"/arm/urdf", "<robot/>"}, {"/urdf", "<robot/>"}}, "/urdf")), "/urdf");
  EXPECT_EQ(keyOf(search({{"/arm/urdf", "<robot/>"}}, "/urdf")), "none");
}

TEST(DescriptionSearch, WhatIsNoXmlIsFoundOnlyWhenNothingElseIs) {
  const auto found = search({{"/arm/urdf", "arm.urdf"}}, "urdf");
  EXPECT_EQ(keyOf(found), "/arm/urdf");
  EXPECT_FALSE(found->is_xml);
  EXPECT_EQ(keyOf(search({{"/arm/urdf", "arm.urdf"}, {"/urdf", "<robot/>"}}, "urdf")), "/urdf");
  EXPECT_EQ(keyOf(search({{"/arm/node/urdf", "arm.urdf"}}, "urdf")), "none");
}

}  // namespace
}  // namespace concave_distance::description_search_test
