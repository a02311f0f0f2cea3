#include "concave_distance/loading/resource_locator.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"

namespace concave_distance::resource_locator_test {
namespace {

class ResourceLocator : public ::testing::Test {
 protected:
  ResourceLocator() {
    locator = [this](const std::string& package) {
      return package == "arm" ? folder.path("packages/arm") : std::string();
    };
  }

  std::string locate(const std::string& resource) {
    return locateResource(resource, folder.path("urdf"), locator);
  }

  // The whole message of the error that locating the resource must end in.
  std::string refusal(const std::string& resource, const std::string& base = "/nowhere") {
    try {
      return "found " + locateResource(resource, base, locator);
    } catch (const Error& error) {
      return error.what();
    }
  }

  test::TemporaryFolder folder;
  PackageLocator locator;
};

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ResourceLocator, PackageUriIsLookedUpInThePackagesFolder) {
  const std::string file = folder.write("packages/arm/meshes/link.stl", "x");
  EXPECT_EQ(locate("package://arm/meshes/link.stl"), file);
}

TEST_F(ResourceLocator, FileUriIsAnAbsolutePath) {
  const std::string file = folder.write("a/link.stl", "x");
  EXPECT_EQ(locate("file://" + file), file);
  EXPECT_EQ(locate("file://localhost" + file), file);
}

TEST_F(ResourceLocator, PlainPathIsAbsoluteOrRelativeToTheBaseFolder) {
  const std::string file = folder.write("urdf/meshes/link.stl", "x");
  EXPECT_EQ(locate(file), file);
  EXPECT_EQ(locate("meshes/link.stl"), file);
}

TEST_F(ResourceLocator, SpacesMayBePlainOrPercentEncoded) {
  const std::string file = folder.write("packages/arm/my meshes/upper arm.stl", "x");
  folder.write("urdf/arm.urdf", "x");
  EXPECT_EQ(locate("package://arm/my meshes/upper arm.stl"), file);
  EXPECT_EQ(locate("package://arm/my%20meshes/upper%20arm.stl"), file);
  EXPECT_EQ(locate("file://" + folder.path("packages/arm/my%20meshes/upper%20arm.stl")), file);
  EXPECT_EQ(locate("../packages/arm/my%20meshes/upper%20arm.stl"),
            folder.path("urdf/../packages/arm/my meshes/upper arm.stl"));
}

TEST_F(ResourceLocator, PercentSignsThatNameTheFileAreTakenLiterally) {
  const std::string coded = folder.write("urdf/a%20b.stl", "x");
  const std::string plain = folder.write("urdf/50%.stl", "x");
  EXPECT_EQ(locate("a%20b.stl"), coded);
  EXPECT_EQ(locate("file://" + coded), coded);
  EXPECT_EQ(locate("50%.stl"), plain);
  EXPECT_EQ(locate("file://" + plain), plain);
}

TEST_F(ResourceLocator, MissingFileIsNamedWithThePathTried) {
  const std::string text = refusal("package://arm/meshes/gone.stl");
  EXPECT_TRUE(mentions(text, "package://arm/meshes/gone.stl")) << text;
  EXPECT_TRUE(mentions(text, folder.path("packages/arm/meshes/gone.stl"))) << text;
  EXPECT_TRUE(mentions(text, "does not exist")) << text;
}

TEST_F(ResourceLocator, UnknownPackageIsNamed) {
  EXPECT_TRUE(mentions(refusal("package://leg/a.stl"), "package 'leg' is not known"));
  locator = nullptr;
  EXPECT_TRUE(mentions(refusal("package://arm/a.stl"), "package 'arm' is not known"));
}

TEST_F(ResourceLocator, WhatIsNoFileIsRefused) {
  folder.write("packages/arm/meshes/link.stl", "x");
  EXPECT_TRUE(mentions(refusal("package://arm/meshes"), "is a folder"));
  EXPECT_TRUE(mentions(refusal("/dev/null"), "no regular file"));
  EXPECT_TRUE(mentions(refusal(""), "empty"));
  EXPECT_TRUE(mentions(refusal("package://arm"), "a package and a file"));
  EXPECT_TRUE(mentions(refusal("package:///a.stl"), "a package and a file"));
  EXPECT_TRUE(mentions(refusal("file://meshes/link.stl"), "'meshes'"));
  EXPECT_TRUE(mentions(refusal("model://arm/a.stl"), "scheme 'model'"));
  EXPECT_TRUE(mentions(refusal("http://host/a.stl"), "scheme 'http'"));
  EXPECT_TRUE(mentions(refusal("file:///a%00b"), "zero byte"));
}

TEST_F(ResourceLocator, RelativePathNeedsAFileToBeRelativeTo) {
  EXPECT_TRUE(mentions(refusal("meshes/link.stl", ""), "relative path"));
}

TEST_F(ResourceLocator, EnvironmentGivesPackagesOfWorkspacesPrefixesAndNestedRepositories) {
  folder.write("direct/arm/package.xml", "<package><name>arm</name></package>");
  folder.write("prefix/share/hand/package.xml", "<package><name>hand</name></package>");
  folder.write("nested/repository-main/leg-1.0/package.xml", "<package><name>leg</name></package>");
  folder.write("nested/ignored/CATKIN_IGNORE", "");
  folder.write("nested/ignored/foot/package.xml", "<package><name>foot</name></package>");
  ::setenv("ROS_PACKAGE_PATH", (folder.path("direct") + "::" + folder.path("nested")).c_str(), 1);
  ::setenv("CMAKE_PREFIX_PATH", folder.path("prefix").c_str(), 1);
  EXPECT_EQ(packagePathFromEnvironment("arm"), folder.path("direct/arm"));
  EXPECT_EQ(packagePathFromEnvironment("hand"), folder.path("prefix/share/hand"));
  EXPECT_EQ(packagePathFromEnvironment("leg"), folder.path("nested/repository-main/leg-1.0"));
  EXPECT_EQ(packagePathFromEnvironment("foot"), "");
  EXPECT_EQ(packagePathFromEnvironment("no_such_package_anywhere"), "");
  EXPECT_EQ(packagePathFromEnvironment("../direct/arm"), "");
  EXPECT_EQ(packagePathFromEnvironment(""), "");
  ::unsetenv("ROS_PACKAGE_PATH");
  ::unsetenv("CMAKE_PREFIX_PATH");
  EXPECT_EQ(packagePathFromEnvironment("arm"), "");
}

TEST_F(ResourceLocator, PackagesAreFoundBelowFoldersThatAreNamed) {
  folder.write("workspace/src/robots/hand/package.xml", "<package><name>hand</name></package>");
  const std::string file = folder.write("workspace/src/robots/hand/palm.stl", "x");
  const PackageLocator named = packagesBelow({folder.path("workspace/src")});
  EXPECT_EQ(locateResource("package://hand/palm.stl", "", named), file);
  EXPECT_EQ(named("no_such_package"), "");
}

}  // namespace
}  // namespace concave_distance::resource_locator_test
