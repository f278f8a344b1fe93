// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "exhibit/scenery/stage_place.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// The layout, in metres of the paper's wall: another wall shows it as large as it has room for. The origin is the
// contact point; x right, y up, z out of the wall towards the viewer.
inline constexpr double kReferenceWallWidthM = 3.048, kReferenceWallHeightM = 2.286;
// What the current material's stroke fills, and the tip's length: the lifted lever, which comes forward as it rises
// along the tilted sample's normal, is then seen below the banner.
inline constexpr double kStrokeHeight = 0.30 * kReferenceWallHeightM;
inline constexpr double kTipDrawnLength = 0.14;
inline constexpr double kSampleTiltRad = 0.26;    // towards the viewer, so that terraces are seen
inline constexpr double kLeverAzimuthRad = 0.42;  // the lever comes from behind, a little from the left
inline constexpr double kLeverDrawnLength = 1.25;
inline constexpr double kLeverDrawnThickness = 0.0125;
inline constexpr double kStageDrawnWidth = 1.44;  // before the wall it reaches to the panels beside it
inline constexpr double kLeastPost = 0.08;        // from the floor to the stage
// The light comes from the upper face's side of the lever however it bends; both are seen below the banner.
inline constexpr glm::dvec3 kLaser(-0.48, 0.79, -0.18);
inline constexpr glm::dvec3 kPhotodiode(0.56, 0.80, -0.42);
inline constexpr double kPhotodiodeHalfSize = 0.0875;
inline constexpr double kSpotReach = 0.8;  // of the half size, at the deflection of the pull-off
inline constexpr double kBeamRadius = 0.007;
inline constexpr double kSpotRadius = 0.032;
inline constexpr glm::dvec3 kWandGrip(0.66, -0.24, 1.00);
inline constexpr double kShelfY = -0.85, kHighestShelfY = -0.45;
inline constexpr double kShelfHeight = 0.10;  // with the swatches' names
inline constexpr double kShelfZ = 0.62;
inline constexpr double kSwatchSpacing = 0.42;
inline constexpr std::size_t kFrontSwatches =
    5;  // as many as a row of the shelf holds; the others stand behind, raised
inline constexpr double kBackRise = 0.25;
inline constexpr double kBackZ = 0.52;  // before the stage
inline constexpr double kBackSpacing = 0.38;
inline constexpr double kSwatchRadius = 0.16;
inline constexpr std::size_t kFewSwatches = 3;
inline constexpr double kSlimSwatchRadius = 0.11;  // of more than a few: the ray passes over one on its way to another
inline constexpr glm::dvec3 kSwatchCenter(0.0, 0.13, 0.0);
inline constexpr double kSwatchReach = 0.17, kWandReach = 0.15;  // how much nearer to the viewer they reach
inline constexpr double kLeastShelfZ = 0.10;
inline constexpr double kComfortMargin = 0.95;  // of the one degree: who moves a little stays within it
inline constexpr double kRayGap = 0.08;         // the ray ends just before what it points at
inline constexpr double kFreeRayLength = 1.2;
inline constexpr double kLongestRay = 3.0;
inline constexpr glm::dvec3 kTowardsViewer(0.0, 0.0, 1.6);
inline constexpr double kLabelWidth = 0.27;
inline constexpr double kLabelHeight = 0.072;
inline constexpr double kLabelLift = 0.002;
inline constexpr double kPanelMargin = 0.03;
inline constexpr double kPanelInnerEdge = 0.74;
inline constexpr double kPanelBottom = -0.20;
inline constexpr double kPanelHeight = 0.92;
inline constexpr double kTabHeight = 0.10;
// right of the sample, which is in front of the wall
inline constexpr double kParameterInset = 0.06;
inline constexpr double kTabInset = 0.18;
// the ruler on the sample, right of the tip, in the wall's plane
inline constexpr glm::dvec3 kRulerFoot(0.45, 0.0, 0.0);
inline constexpr double kRulerLongest = 0.46;
inline constexpr double kRulerTick = 0.026;
inline constexpr double kRulerRadius = 0.0045;
inline constexpr double kRulerTextGap = 0.04;
inline constexpr double kRulerTextWidth = 0.22;
inline constexpr double kRulerTextHeight = 0.08;
// the colours of a measured sample's heights, in the wall's plane, below the panel on the right
inline constexpr double kHeightBarX = 0.80, kHeightBarBottom = -0.80;
inline constexpr double kHeightBarHeight = 0.27, kHeightBarWidth = 0.045;
inline constexpr double kHeightBarTextWidth = 0.24, kHeightBarTextHeight = 0.07;
inline constexpr double kHeightBarTextGap = 0.02;
inline constexpr double kUnbentBeyond = 0.16;
inline constexpr double kUnbentBeside = 0.09;  // of the tip's axis: right of it
inline constexpr double kUnbentLowest = 0.05;  // over the sample, whose terraces rise behind the tip
inline constexpr double kUnbentRadius = 0.0045;
inline constexpr double kBendRadius = 0.008;
inline constexpr double kShadeRadius = 0.085;  // of the soft shade where the tip meets the sample
// the line of a scan, over the sample
inline constexpr double kScanLineRadius = 0.004;
inline constexpr double kScanLineLift = 0.004;  // over the surface
// the analogy's stroke is smaller than the instrument's, so that the hand stays below the banner
inline constexpr double kAnalogyScale = 0.55;
inline constexpr double kAnalogyLabelWidth = 0.40;
inline constexpr double kAnalogyLabelHeight = 0.075;
inline constexpr double kAnalogyLabelGap = 0.16;
inline constexpr glm::dvec3 kAnalogyPlateLabel(0.0, -0.382, -0.07);  // in the sample's frame, on the plate's front
inline constexpr double kCompanionLabelWidth = 0.44, kCompanionLabelHeight = 0.075;  // on the journey
inline constexpr float kFogBegin = 3.5F, kFogEnd = 14.0F;                            // behind the wall, on the journey
inline constexpr double kBannerHeight = 0.21;
// of the wall below and above the contact point: the shelf is seen whole, and the banner is above the panels
inline constexpr double kRoomBelow = 1.20;
inline constexpr double kRoomAbove = kPanelBottom + kPanelHeight + kBannerHeight + 2.0 * kPanelMargin;

// The same where the panels stand below the shelf; the contact point is then a third of the height from the top.
inline constexpr double kBelowBottom = -kRoomBelow - 0.08 - kPanelHeight;  // the stage's foot is seen above them
inline constexpr double kRoomBelowPanels = -kBelowBottom + 2.0 * kPanelMargin + kTabHeight;
inline constexpr double kRoomAboveNarrow = 0.5 * kRoomBelowPanels;
inline constexpr double kNarrowWidth = 1.75;  // of a composition without panels beside it
inline constexpr double kWidestPanel = 1.6 * kPanelHeight;
inline constexpr double kWidestPlot = 2.0 * kPanelInnerEdge + 0.724;  // of the finale: as on the paper's wall
inline constexpr double kCornerGap = 0.10;                            // from the corner of two screens to a panel

// The stroke of a cycle in units of Z_joc: from the deepest push below zero to the highest lift.
inline constexpr double kStrokeOfZjoc = 0.30 + 1.40;

// The place of the panels: beside the instrument, below the shelf of an upright screen, or on the side screens.
enum class Arrangement { Beside, Below, SideScreens };

struct WallShape {
  Arrangement arrangement = Arrangement::Beside;
  double unit_m = 1.0;  // what of the room a unit of the layout is
};

// The arrangement in which all is largest, with the side screens in use where there are two.
WallShape wall_shape(const StagePlace& stage);

// From so far below the contact point's height, as before a floor screen, who looks would see the sample's edge alone:
// then instrument and shelf are turned to be seen as from the paper's wall. Radians.
inline constexpr double kLowestLookRad = 0.35;

// Axes and origin as columns.
glm::dmat4 frame_matrix(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& origin);

// A frame at `origin` whose z axis looks along `direction`, upright as far as possible.
glm::dmat4 looking_along(const glm::dvec3& origin, const glm::dvec3& direction);

// A unit cylinder along +z, stretched between two points.
glm::dmat4 stretched(const glm::dvec3& from, const glm::dvec3& to, double radius);

}  // namespace afm::exhibit
