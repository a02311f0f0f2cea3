#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "loading/saved_scene.h"
#include "support/scene_fixture.h"

namespace concave_distance::test::cloud_spec_test {
namespace {

class CloudSpec : public SceneTest {
 protected:
  CloudSpec() { options.clouds = true; }

  static std::string cloud(const std::string& more = "") {
    return "clouds:\n  - name: camera\n    topic: /points\n    frame: base\n" + more;
  }
  void expectRefused(const std::string& key, const std::string& value, const std::string& allowed) const {
    const std::string text = refusal(cloud("    " + key + ": " + value + "\n"));
    EXPECT_EQ(text.rfind("scene.yaml:5, clouds[0]." + key + ": ", 0), 0U) << text;
    EXPECT_NE(text.find(allowed), std::string::npos) << text;
  }
};

TEST_F(CloudSpec, DefaultsAreThoseOfTheDocumentation) {
  const Scene scene = load(cloud());
  ASSERT_EQ(bodyNames(scene), std::vector<std::string>{"camera"});
  const CloudSettings& settings = *scene.bodies[0].cloud->settings;
  EXPECT_EQ(settings.topic, "/points");
  EXPECT_EQ(scene.bodies[0].frame, "base");
  EXPECT_EQ(settings.voxel_size, 0.05);
  EXPECT_EQ(settings.range, std::numeric_limits<double>::infinity());
  EXPECT_EQ(settings.rate, 5.0);
  EXPECT_EQ(settings.stale_after, 1.0);
  EXPECT_EQ(settings.padding, 0.02);
  EXPECT_TRUE(settings.leave_out.empty());
  EXPECT_FALSE(settings.niches);
  EXPECT_EQ(settings.largest_voxel_count, 200'000U);
  EXPECT_FALSE(scene.bodies[0].cloud->stamp) << "none has come yet";
  EXPECT_FALSE(scene.bodies[0].cloud->hasVoxels());
}

TEST_F(CloudSpec, WhatIsMissingIsNamed) {
  EXPECT_NE(refusal("clouds:\n  - topic: /points\n    frame: base\n").find("give every cloud a name"),
            std::string::npos);
  EXPECT_NE(refusal("clouds:\n  - name: camera\n    frame: base\n").find("name the topic"),
            std::string::npos);
  EXPECT_NE(refusal("clouds:\n  - name: camera\n    topic: /points\n").find("name the tf frame"),
            std::string::npos);
}

TEST_F(CloudSpec, ValuesOutOfRangeAreRefusedWithWhatIsAllowed) {
  for (const char* size : {"0", "-1", "11", ".nan", "small"})
    expectRefused("voxel_size", size, "0.0001 to 10");
  for (const char* range : {"0", "-.inf", ".nan", "far"}) expectRefused("range", range, "a positive number");
  for (const char* rate : {"0", "1001", ".inf", "often"})
    expectRefused("rate", rate, "above 0, at most 1000");
  for (const char* age : {"0", "-1", ".nan", "never"}) expectRefused("stale_after", age, "a positive number");
  for (const char* padding : {"-0.1", "11", ".nan"}) expectRefused("padding", padding, "0 to 10");
  expectRefused("leave_out", "table", "a list of bodies");
  expectRefused("niches", "2", "true or false");
  for (const char* count : {"0", "1000001", "1.5", "many"})
    expectRefused("largest_voxel_count", count, "1000000");
  expectRefused("mesh", "part.stl", "allowed: name, frame, topic, voxel_size");
}

TEST_F(CloudSpec, NamesStandOnceAndAreNoPatterns) {
  EXPECT_NE(refusal(cloud() + "bodies:\n  - name: camera\n    sphere: {radius: 1}\n").find("camera"),
            std::string::npos);
  EXPECT_NE(refusal("clouds:\n  - {name: 'c*', topic: /points, frame: base}\n").find("without * ? ["),
            std::string::npos);
}

TEST_F(CloudSpec, ToolsLeaveCloudsOutWithAWarning) {
  options.clouds = false;
  const Scene scene = load(cloud() + "bodies:\n  - name: ball\n    frame: ball\n    sphere: {radius: 1}\n");
  EXPECT_EQ(bodyNames(scene), std::vector<std::string>{"ball"});
  EXPECT_EQ(std::count(scene.warnings.begin(), scene.warnings.end(),
                       "cloud 'camera' is left out, because only the node receives clouds"),
            1);
}

TEST_F(CloudSpec, EverySettingIsSavedAndReadAgain) {
  const Scene scene = load(
      cloud(
          "    voxel_size: 0.125\n    range: 3.5\n    rate: 2.5\n    stale_after: .inf\n    padding: 0.25\n"
          "    leave_out: ['ba*', ball]\n    niches: true\n    largest_voxel_count: 77\n    margin: 0.01\n") +
      "bodies:\n  - name: ball\n    frame: ball\n    sphere: {radius: 1}\n");
  const CloudSettings& settings = *scene.bodies[*scene.findBody("camera")].cloud->settings;
  EXPECT_EQ(settings.voxel_size, 0.125);
  EXPECT_EQ(settings.largest_voxel_count, 77U);
  const Scene again = load(detail::savedScene(scene, "cell").front().text);
  const SceneBody& body = again.bodies[*again.findBody("camera")];
  ASSERT_TRUE(body.cloud);
  EXPECT_TRUE(*body.cloud->settings == settings);
  EXPECT_EQ(body.frame, "base");
  EXPECT_EQ(body.margin, 0.01);
}

}  // namespace
}  // namespace concave_distance::test::cloud_spec_test
