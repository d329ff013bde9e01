// SPDX-License-Identifier: BSD-3-Clause
// Log-log charts as SVG text, for the page and for pictures of their own.
#pragma once

#include <string>
#include <vector>

#include "chart/work.hpp"

namespace host::chart {

/// What the abscissa of a work-precision diagram is.
enum class Price { time, contact_time, segments, dofs };
inline constexpr Price prices[] = {Price::time, Price::contact_time, Price::segments, Price::dofs};
double price_of(const WorkRun& run, Price price);
const char* label_of(Price price);

/// Colour of a family's curves.
const char* color_of(Family family);

/// A family's marker at a place, as SVG.
/// @param hollow  of an area that is counted
std::string marker(Family family, double x, double y, const std::string& title, bool hollow = false);

/// One diagram, 440 x 320: its content without the svg element.
std::string work_panel(const Work& work, Price price, const std::string& heading);
inline constexpr int panel_width = 440, panel_height = 320;

/// The diagram as an element of the page.
std::string work_svg(const Work& work, Price price);

/// Several problems, a row each, as one picture of its own, with a legend.
std::string work_picture(const std::vector<const Work*>& works, const std::vector<Price>& columns);

} // namespace host::chart
