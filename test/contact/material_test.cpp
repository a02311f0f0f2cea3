#include "concave_distance/contact/material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"

namespace concave_distance::material_test {
namespace {

TEST(Material, ContactModulusIsTheFractionOfEquationA2) {
  Material a;
  a.youngs_modulus = 2.1e11;
  a.poissons_ratio = 0.29;
  Material b;
  b.youngs_modulus = 7e10;
  b.poissons_ratio = 0.33;
  const double numerator = a.youngs_modulus * b.youngs_modulus;
  const double denominator = a.youngs_modulus * (1.0 - b.poissons_ratio * b.poissons_ratio) +
                             b.youngs_modulus * (1.0 - a.poissons_ratio * a.poissons_ratio);
  EXPECT_NEAR(inContact(a, b).contact_modulus, numerator / denominator, 1e-14 * numerator / denominator);
}

TEST(Material, TheOrderOfTheBodiesDoesNotMatter) {
  Material a;
  Material b;
  b.youngs_modulus = 1e6;
  b.dissipation = 0.7;
  b.dynamic_friction = 0.1;
  const ContactMaterial ab = inContact(a, b);
  const ContactMaterial ba = inContact(b, a);
  EXPECT_DOUBLE_EQ(ab.contact_modulus, ba.contact_modulus);
  EXPECT_DOUBLE_EQ(ab.dissipation, ba.dissipation);
  EXPECT_DOUBLE_EQ(ab.static_friction, ba.static_friction);
  EXPECT_DOUBLE_EQ(ab.dynamic_friction, ba.dynamic_friction);
}

TEST(Material, TheSoftBodyTakesTheDeformationAndGivesItsDamping) {
  Material steel;
  steel.youngs_modulus = 2e11;
  steel.dissipation = 0.0;
  Material rubber;
  rubber.youngs_modulus = 1e6;
  rubber.poissons_ratio = 0.48;
  rubber.dissipation = 0.5;
  const ContactMaterial pair = inContact(steel, rubber);
  EXPECT_NEAR(pair.contact_modulus, 1e6 / (1.0 - 0.48 * 0.48), 10.0);
  EXPECT_NEAR(pair.dissipation, 0.5, 1e-4);
}

TEST(Material, AFrictionlessBodySlidesOnEverything) {
  Material ice;
  ice.static_friction = ice.dynamic_friction = 0.0;
  const ContactMaterial pair = inContact(ice, Material{});
  EXPECT_EQ(pair.static_friction, 0.0);
  EXPECT_EQ(pair.dynamic_friction, 0.0);
}

TEST(Material, TheBodyThatResistsTurningMoreCounts) {
  Material steel;
  Material carpet;
  steel.spinning_friction = 1e-4;
  carpet.rolling_friction = 5e-3;
  for (const ContactMaterial& pair : {inContact(steel, carpet), inContact(carpet, steel)}) {
    EXPECT_EQ(pair.rolling_friction, 5e-3);
    EXPECT_EQ(pair.spinning_friction, 1e-4);
  }
  EXPECT_EQ(inContact(Material{}, Material{}).rolling_friction, 0.0);
}

TEST(Material, WhatNoMaterialHasIsRefusedByName) {
  const auto message = [](auto change) -> std::string {
    Material material;
    change(material);
    try {
      material.validate("bodies.peg.material");
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message([](Material& m) { m.youngs_modulus = -1.0; }),
            "bodies.peg.material: youngs_modulus is -1 (allowed: greater than 0 (Pa))");
  EXPECT_EQ(message([](Material& m) { m.poissons_ratio = 0.5; }),
            "bodies.peg.material: poissons_ratio is 0.5 (allowed: from 0 to below 0.5)");
  EXPECT_EQ(message([](Material& m) { m.static_friction = 0.3; }),
            "bodies.peg.material: static_friction is 0.3 (allowed: dynamic_friction (0.4) or more, finite)");
  EXPECT_EQ(message([](Material& m) { m.rolling_friction = -1e-3; }),
            "bodies.peg.material: rolling_friction is -0.001 (allowed: 0 or more (m))");
  EXPECT_EQ(message([](Material& m) { m.spinning_friction = -1.0; }),
            "bodies.peg.material: spinning_friction is -1 (allowed: 0 or more (m))");
  EXPECT_NE(message([](Material& m) { m.dissipation = std::nan(""); }), "accepted");
  EXPECT_EQ(message([](Material&) {}), "accepted");
}

}  // namespace
}  // namespace concave_distance::material_test
