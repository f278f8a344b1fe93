// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "exhibit/scenery/stage_place.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// The layout in metres of the paper's wall; another wall shows it as large as possible. The origin is the contact
// point; x right, y up, z out of the wall towards the viewer.
inline constexpr double kReferenceWallWidthM = 3.048, kReferenceWallHeightM = 2.286;
// Drawn height of the current material's stroke, and the tip's length. The lifted lever, which moves forward along the
// tilted sample's normal, then remains visible below the banner.
inline constexpr double kStrokeHeight = 0.30 * kReferenceWallHeightM;
// Limits of the drawn sample's width in strokes; 1.70 to 1.71 for the paper's three.
inline constexpr double kNarrowestSample = 1.6, kWidestSample = 1.8;
inline constexpr double kTipDrawnLength = 0.14;
inline constexpr double kSmallestSwing = 0.004;   // half height of the band that shows a tapping lever's swing
inline constexpr double kSampleTiltRad = 0.26;    // tilt towards the viewer that makes terraces visible
inline constexpr double kLeverAzimuthRad = 0.42;  // direction of the lever: from behind, a little from the left
inline constexpr double kLeverDrawnLength = 1.25;
inline constexpr double kLeverDrawnThickness = 0.0125;
inline constexpr double kStageDrawnWidth = 1.44;  // width between the panels on both sides, in front of the wall
inline constexpr double kLeastBodyDepth = 0.2;    // least fraction of the whole depth of the body below the plate
inline constexpr double kLeastBody = 0.08;        // least height of the stage's plate above the floor
// The light is always on the upper side of the lever, however it bends; both are visible below the banner.
inline constexpr glm::dvec3 kLaser(-0.48, 0.79, -0.18);
inline constexpr glm::dvec3 kPhotodiode(0.56, 0.80, -0.42);
inline constexpr double kPhotodiodeHalfSize = 0.0875;
inline constexpr double kSpotReach = 0.8;  // fraction of the half size at the deflection of the pull-off
inline constexpr double kBeamRadius = 0.007;
inline constexpr double kSpotRadius = 0.032;
inline constexpr glm::dvec3 kWandGrip(0.66, -0.18, 1.00);
// height of the shelf in front of the plate; below it if the eyes allow no place that near
inline constexpr double kShelfY = -0.52, kLowestShelfY = -0.79, kHighestShelfY = -0.45;
inline constexpr double kNearShelfZ = 0.50;
inline constexpr double kShelfHeight = 0.10;  // height including the swatches' names
inline constexpr double kShelfZ = 0.62;
inline constexpr double kSwatchSpacing = 0.42;
inline constexpr std::size_t kFrontSwatches = 5;  // number in the front row of the shelf; others are raised behind it
inline constexpr double kBackRise = 0.25;
inline constexpr double kBackZ = 0.52;  // distance in front of the stage
inline constexpr double kBackSpacing = 0.38;
inline constexpr double kSwatchRadius = 0.11;  // small enough for the wand's ray to pass
inline constexpr glm::dvec3 kSwatchCenter(0.0, 0.13, 0.0);
inline constexpr double kSwatchBehind = 0.11;                    // extent away from the viewer
inline constexpr double kSwatchReach = 0.17, kWandReach = 0.15;  // extent towards the viewer
inline constexpr double kLeastShelfZ = 0.10;
inline constexpr double kComfortMargin = 0.95;  // fraction of the one degree; allows for small motions of the viewer
inline constexpr double kRayGap = 0.08;         // gap between the ray's end and its target
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
// insets to the right of the sample, which is in front of the wall
inline constexpr double kParameterInset = 0.06;
inline constexpr double kTabInset = 0.18;
// ruler on the sample, right of the tip, in the wall's plane
inline constexpr glm::dvec3 kRulerFoot(0.45, 0.0, 0.0);
inline constexpr double kRulerLongest = 0.46;
inline constexpr double kRulerTick = 0.026;
inline constexpr double kRulerRadius = 0.0045;
inline constexpr double kRulerTextGap = 0.04;
inline constexpr double kRulerTextWidth = 0.22;
inline constexpr double kRulerTextHeight = 0.08;
// colour scale of heights, in the wall's plane, left of the plate, since the wand rests on the right
inline constexpr double kHeightBarX = -0.945, kHeightBarBottom = -0.515;
inline constexpr double kHeightBarHeight = 0.15, kHeightBarWidth = 0.045;
inline constexpr double kHeightBarTextWidth = 0.24, kHeightBarTextHeight = 0.07;
inline constexpr double kHeightBarTextGap = 0.02;
inline constexpr double kUnbentBeyond = 0.16;
inline constexpr double kUnbentBeside = 0.09;  // distance to the right of the tip's axis
inline constexpr double kUnbentLowest = 0.05;  // height above the sample, clear of terraces behind the tip
inline constexpr double kUnbentRadius = 0.0045;
// the arrow of the force, beside the lever
inline constexpr double kForceRadius = 0.009;
inline constexpr double kForceHeadLength = 0.065, kForceHeadRadius = 0.026;
// word and number of a jump, left of the tip, over the sample and below the lever: lower left corner
inline constexpr glm::dvec2 kCuePlace(-0.73, 0.075);
inline constexpr double kCueWidth = 0.54, kCueHeight = 0.10;
inline constexpr double kCueGap = 0.01;        // visible distance to the panel on its left
inline constexpr double kShadeRadius = 0.085;  // radius of the soft shade at the contact
// the scan line, over the sample
inline constexpr double kScanLineRadius = 0.004;
inline constexpr double kScanLineLift = 0.004;  // height above the surface
inline constexpr double kReliefLift = 0.003;    // height of an image above the surface on which it lies
// the curves of a force map over the sample, and the colour scale of their forces
inline constexpr double kVolumeHeight = 0.75 * kStrokeHeight, kLeastVolumeHeight = 0.3 * kStrokeHeight;
inline constexpr double kForceBarWidth = 0.08;  // fraction of the scale's height
// scale smaller than the instrument's stroke, so that the hand stays below the banner
inline constexpr double kAnalogyScale = 0.55;
inline constexpr double kAnalogyLabelWidth = 0.40;
inline constexpr double kAnalogyLabelHeight = 0.075;
inline constexpr double kAnalogyLabelGap = 0.16;
inline constexpr glm::dvec3 kAnalogyPlateLabel(0.0, -0.382, -0.07);  // place on the plate's front in the sample's frame
inline constexpr double kCompanionLabelWidth = 0.44, kCompanionLabelHeight = 0.075;  // size of the label in the journey
// ladder of powers of ten on the left, and name of the gap beside its bar
inline constexpr double kRungWidth = 0.24, kRungHeight = 0.075, kRungPitch = 0.088, kLowestRung = -0.10;
inline constexpr double kGapLabelWidth = 0.34, kGapLabelHeight = 0.075, kGapLabelRight = -0.05;
inline constexpr double kGapFromOrders = 8.4;
// name of the apex; at these scales only its underside is visible above the sample
inline constexpr double kApexFromOrders = 7.8, kApexToOrders = 8.75;
inline constexpr double kApexLabelBottom = 0.40, kApexLabelWidth = 0.60;
inline constexpr float kFogBegin = 3.5F, kFogEnd = 14.0F;  // distances behind the wall in the journey
inline constexpr double kBannerHeight = 0.21;
// extent of the wall below and above the contact point: the whole shelf is visible, and the banner is above panels and
// photodiode
inline constexpr double kRoomBelow = 0.86;
inline constexpr double kDeepRoomBelow = 1.20;  // extent with the shelf below the plate
inline constexpr double kRoomAbove = kPhotodiode.y + 0.3 * kPhotodiodeHalfSize + kBannerHeight + kPanelMargin;

// Extent with the panels below the shelf. The contact point is then a third of the height from the top.
inline constexpr double kBelowBottom = -kDeepRoomBelow - 0.08 - kPanelHeight;  // room for the stage's foot included
inline constexpr double kRoomBelowPanels = -kBelowBottom + 2.0 * kPanelMargin + kTabHeight;
inline constexpr double kRoomAboveNarrow = 0.5 * kRoomBelowPanels;
inline constexpr double kNarrowWidth = 1.75;  // width of a composition without panels at its sides
inline constexpr double kWidestPanel = 1.6 * kPanelHeight;
inline constexpr double kWidestPlot = 2.0 * kPanelInnerEdge + 0.724;  // width of the finale's plot, as in the paper
inline constexpr double kFarthestSightRad = 0.80;  // largest angle of a panel: a turn of head and eyes
inline constexpr double kCornerGap = 0.10;         // gap between the corner of two screens and a panel

// The stroke of a cycle in units of Z_joc: from the deepest push below zero to the highest lift.
inline constexpr double kStrokeOfZjoc = 0.30 + 1.40;

// Place of the panels: beside the instrument, below the shelf of an upright screen, or on the side screens.
enum class Arrangement { Beside, Below, SideScreens };

struct WallShape {
  Arrangement arrangement = Arrangement::Beside;
  double unit_m = 1.0;  // size of a layout unit in the room
  double room_below = kRoomBelow;
};

// Arrangement with the largest scale. Uses the side screens if there are two. The shelf is in front of the
// plate if `swatches` fit in one row and the screens do not surround the viewer.
// The scale is smaller before a floor, where the banner would hide the instrument's upper end.
WallShape wall_shape(const StagePlace& stage, std::size_t swatches = kFrontSwatches);

// Elevation of the view, radians, below which only the sample's edge would be visible, as in front of a floor screen.
// Below it, instrument and shelf are rotated to look as from the paper's wall.
inline constexpr double kLowestLookRad = 0.35;

// Point where the tip meets the sample.
struct Contact {
  double height_m = 0;       // height above the screen's lower edge
  glm::dvec3 place_m{0.0};   // place in the room
  glm::dvec3 to_eye_m{0.0};  // direction to the eyes in the screen's axes: right, up, out
  double turn_rad = 0;       // turn about the screen's x axis, towards a viewer far above; 0: upright
};
Contact contact_of(const StagePlace& stage, const WallShape& shape);

// Matrix with axes and origin as columns.
glm::dmat4 frame_matrix(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& origin);

// A frame at `origin` whose z axis is `direction`, as upright as possible.
glm::dmat4 looking_along(const glm::dvec3& origin, const glm::dvec3& direction);

// Transform of a unit cylinder along +z to one between two points.
glm::dmat4 stretched(const glm::dvec3& from, const glm::dvec3& to, double radius);

}  // namespace afm::exhibit
