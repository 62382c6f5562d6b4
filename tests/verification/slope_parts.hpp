// Parts of models of slopes as TOML, and what limit equilibrium takes from their geometry.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/polygon.hpp"

namespace edda::slopes {

constexpr double unit_weight = 26e3, water_weight = 9810.0;  ///< N/m3

std::string point(Vec2 p);
std::string points(const std::vector<Vec2>& list);
std::string trace(Vec2 a, Vec2 b, const std::string& joint);
/// A joint whose residual strength is its peak strength; phi in degrees.
std::string law(const std::string& name, double phi, double cohesion);
std::string rock();
/// Rock below a base from the toe (its first point) up, and the rock between it and the surface.
std::string ground(const Ring& base, const std::vector<Vec2>& surface);
/// Water under a table, nothing where that is empty. `flooded`: names of openings.
std::string water(const std::vector<Vec2>& table, const std::string& flooded = {});

/// Part of a ring where `side` is positive.
Ring clip(const Ring& ring, const std::function<double(Vec2)>& side);
double area_of(const Ring& ring);
/// Part of the line from a to b that lies in a ring, where the ring is convex along it.
std::array<Vec2, 2> inside(const Ring& ring, Vec2 a, Vec2 b);

/// Pressure of the water at a place, Pa.
double pressure(const std::vector<Vec2>& table, Vec2 at);
/// Its integral from a to b, N/m.
double push(const std::vector<Vec2>& table, Vec2 a, Vec2 b);

}  // namespace edda::slopes
