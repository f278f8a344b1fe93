// SPDX-License-Identifier: Apache-2.0
#pragma once

// Particles. States in the order of physics::PushState, laws in that of physics::ParticleLaw.
#define AFM_FOR_EACH_PARTICLE_PHRASE(PHRASE)                               \
  PHRASE(ParticlesIn, "particles-in", "medium", kLine)                     \
  PHRASE(ParticlesTakeBack, "particles-take-back", "medium count", kLine)  \
  PHRASE(PatternOff, "pattern-off", "distance allowed pushes", kLine)      \
  PHRASE(PatternDone, "pattern-done", "distance pushes", kLine)            \
  PHRASE(PatternFits, "pattern-fits", "distance pushes", kLine)            \
  PHRASE(TaskClock, "task-clock", "", kLine)                               \
  PHRASE(TaskDoneIn, "task-done-in", "", kLine)                            \
  PHRASE(TaskStrokes, "task-strokes", "strokes losses", kLine)             \
  PHRASE(TaskOff, "task-off", "", kLine)                                   \
  PHRASE(TaskUnaided, "task-unaided", "", kLine)                           \
  PHRASE(TaskAided, "task-aided", "count guided", kLine)                   \
  PHRASE(TaskShown, "task-shown", "", kLine)                               \
  PHRASE(TaskAidedShown, "task-aided-shown", "count guided", kLine)        \
  PHRASE(TaskAnswer, "task-answer", "", kLine)                             \
  PHRASE(TaskThreshold, "task-threshold", "force error", kLine)            \
  PHRASE(TaskFound, "task-found", "", kLine)                               \
  PHRASE(TaskYes, "task-yes", "", kLine)                                   \
  PHRASE(TaskNo, "task-no", "", kLine)                                     \
  PHRASE(BlindFeel, "blind-feel", "", kLine)                               \
  PHRASE(BlindPress, "blind-press", "", kLine)                             \
  PHRASE(BlindLine, "blind-line", "", kLine)                               \
  PHRASE(BlindLift, "blind-lift", "", kLine)                               \
  PHRASE(PictureDark, "picture-dark", "", kLine)                           \
  PHRASE(TaskWork, "task-work", "", kLine)                                 \
  PHRASE(TaskLargest, "task-largest", "force", kLine)                      \
  PHRASE(PlanWay, "plan-way", "", kLine)                                   \
  PHRASE(PlanGuided, "plan-guided", "number", kLine)                       \
  PHRASE(PlanUnguided, "plan-unguided", "number", kLine)                   \
  PHRASE(PlanAim, "plan-aim", "", kLine)                                   \
  PHRASE(PlanAimWhy, "plan-aim-why", "", kLine)                            \
  PHRASE(PlanHand, "plan-hand", "", kLine)                                 \
  PHRASE(PlanHandWhy, "plan-hand-why", "delay", kLine)                     \
  PHRASE(PushStateName, "push-state", "", kLine)                           \
  PHRASE(PushFree, "push-free", "", kLine)                                 \
  PHRASE(PushHolds, "push-holds", "", kLine)                               \
  PHRASE(PushSlides, "push-slides", "", kLine)                             \
  PHRASE(PushRolls, "push-rolls", "", kLine)                               \
  PHRASE(PushSeveral, "push-several", "", kLine)                           \
  PHRASE(PushCarried, "push-carried", "", kLine)                           \
  PHRASE(PushHeld, "push-held", "", kLine)                                 \
  PHRASE(PushDragged, "push-dragged", "", kLine)                           \
  PHRASE(PushedParticle, "pushed-particle", "number count species", kLine) \
  PHRASE(PushedNone, "pushed-none", "", kLine)                             \
  PHRASE(PushNormal, "push-normal", "", kLine)                             \
  PHRASE(PushNormalOn, "push-normal-on", "", kLine)                        \
  PHRASE(PushLateral, "push-lateral", "", kLine)                           \
  PHRASE(PushLateralOn, "push-lateral-on", "", kLine)                      \
  PHRASE(PushThreshold, "push-threshold", "", kLine)                       \
  PHRASE(PushOtherLaw, "push-other-law", "", kLine)                        \
  PHRASE(PushLaw, "push-law", "formula", kLine)                            \
  PHRASE(PushLawUnused, "push-law-unused", "formula", kLine)               \
  PHRASE(PushLawArea, "push-law-area", "", kLine)                          \
  PHRASE(PushLawAmontons, "push-law-amontons", "", kLine)                  \
  PHRASE(PushLawBoth, "push-law-both", "", kLine)                          \
  PHRASE(PushLawMeasured, "push-law-measured", "", kLine)                  \
  PHRASE(ParticleRadius, "particle-radius", "", kLine)                     \
  PHRASE(ParticleShearStrength, "particle-shear-strength", "", kLine)      \
  PHRASE(ParticleCoefficient, "particle-coefficient", "", kLine)           \
  PHRASE(ParticleTearsAt, "particle-tears-at", "", kLine)                  \
  PHRASE(LeverSideways, "lever-sideways", "", kLine)                       \
  PHRASE(LeverSoftened, "lever-softened", "", kLine)                       \
  PHRASE(TimesSofter, "times-softer", "factor", kLine)                     \
  PHRASE(LeverSoftenedWhy, "lever-softened-why", "", kLine)                \
  PHRASE(PatternComputed, "pattern-computed", "distance pushes", kLine)    \
  PHRASE(PictureName, "particle-picture", "", kLine)                       \
  PHRASE(PictureMeasured, "picture-measured", "", kLine)                   \
  PHRASE(PictureComputed, "picture-computed", "", kLine)                   \
  PHRASE(PictureStale, "picture-stale", "", kLine)                         \
  PHRASE(PictureLooks, "picture-looks", "share", kLine)                    \
  PHRASE(PictureAge, "picture-age", "level number age doubt", kLine)       \
  PHRASE(LookName, "newest-look", "", kLine)                               \
  PHRASE(LookOff, "look-off", "number lines", kLine)                       \
  PHRASE(LookMissed, "look-missed", "", kLine)                             \
  PHRASE(LookSwept, "look-swept", "", kLine)                               \
  PHRASE(LookSweptBy, "look-swept-by", "number gentle", kLine)             \
  PHRASE(LookLoad, "look-load", "", kLine)                                 \
  PHRASE(LookSweeps, "look-sweeps", "gentle", kLine)                       \
  PHRASE(KeyLook, "key-look", "", kLine)                                   \
  PHRASE(KeyLookLoad, "key-look-load", "", kLine)                          \
  PHRASE(KeyTool, "key-tool", "", kLine)                                   \
  PHRASE(ToolName, "tool", "", kLine)                                      \
  PHRASE(ToolPush, "tool-push", "", kLine)                                 \
  PHRASE(ToolGrip, "tool-grip", "", kLine)                                 \
  PHRASE(ToolPushOf, "tool-push-of", "", kLine)                            \
  PHRASE(ToolNowPush, "tool-now-push", "", kLine)                          \
  PHRASE(ToolNowGrip, "tool-now-grip", "", kLine)                          \
  PHRASE(ToolOfMarks, "tool-of-marks", "", kLine)                          \
  PHRASE(ToolNeedsAdhesion, "tool-needs-adhesion", "", kLine)              \
  PHRASE(ToolOfPicture, "tool-of-picture", "", kLine)                      \
  PHRASE(ToolTooMuch, "tool-too-much", "", kLine)                          \
  PHRASE(ToolWaits, "tool-waits", "", kLine)                               \
  PHRASE(SettingLaw, "setting-law", "", kLine)                             \
  PHRASE(SettingLever, "setting-lever", "", kLine)                         \
  PHRASE(SettingTip, "setting-tip", "", kLine)                             \
  PHRASE(SettingMedium, "setting-medium", "", kLine)                       \
  PHRASE(SettingLevel, "setting-level", "", kLine)                         \
  PHRASE(SettingLevelOwn, "setting-level-own", "", kLine)                  \
  PHRASE(SettingMarked, "setting-marked", "setting value", kLine)          \
  PHRASE(SettingNow, "setting-now", "setting value", kLine)                \
  PHRASE(SettingNoOther, "setting-no-other", "setting", kLine)             \
  PHRASE(SettingNoNumbers, "setting-no-numbers", "", kLine)                \
  PHRASE(SettingsChanged, "settings-changed", "", kLine)                   \
  PHRASE(KeySettings, "key-settings", "", kLine)                           \
  PHRASE(GentleLoad, "gentle-load", "", kLine)                             \
  PHRASE(GentleLoadWhy, "gentle-load-why", "", kLine)                      \
  PHRASE(LeverAtLeast, "lever-at-least", "", kLine)                        \
  PHRASE(LeverEnough, "lever-enough", "spring", kLine)                     \
  PHRASE(LeverTooSoft, "lever-too-soft", "spring", kLine)

// A soft sample that the tip scratches; states as those of physics::PushState up to Slides.
#define AFM_FOR_EACH_SOFT_PHRASE(PHRASE)                 \
  PHRASE(SoftTakeBack, "soft-take-back", "count", kLine) \
  PHRASE(SoftPress, "soft-press", "", kLine)             \
  PHRASE(SoftDrag, "soft-drag", "", kLine)               \
  PHRASE(SoftFree, "soft-free", "", kLine)               \
  PHRASE(SoftHolds, "soft-holds", "", kLine)             \
  PHRASE(SoftMarks, "soft-marks", "", kLine)             \
  PHRASE(SoftDepth, "soft-depth", "", kLine)             \
  PHRASE(SoftDepthOf, "soft-depth-of", "", kLine)        \
  PHRASE(SoftLoad, "soft-load", "", kLine)               \
  PHRASE(SoftSideways, "soft-sideways", "load", kLine)   \
  PHRASE(SoftGroove, "soft-groove", "", kLine)           \
  PHRASE(SoftGrooveOf, "soft-groove-of", "depth", kLine) \
  PHRASE(SoftSpeed, "soft-speed", "", kLine)             \
  PHRASE(SoftSlow, "soft-slow", "", kLine)               \
  PHRASE(SoftFast, "soft-fast", "rise", kLine)           \
  PHRASE(SoftHardness, "soft-hardness", "", kLine)

// Ink with which the tip writes.
#define AFM_FOR_EACH_INK_PHRASE(PHRASE)                  \
  PHRASE(InkTakeBack, "ink-take-back", "count", kLine)   \
  PHRASE(InkTouch, "ink-touch", "", kLine)               \
  PHRASE(InkMove, "ink-move", "", kLine)                 \
  PHRASE(InkFree, "ink-free", "", kLine)                 \
  PHRASE(InkWrites, "ink-writes", "", kLine)             \
  PHRASE(InkForce, "ink-force", "", kLine)               \
  PHRASE(InkTears, "ink-tears", "force", kLine)          \
  PHRASE(InkLine, "ink-line", "", kLine)                 \
  PHRASE(InkLineOf, "ink-line-of", "speed", kLine)       \
  PHRASE(InkRests, "ink-rests", "", kLine)               \
  PHRASE(InkDot, "ink-dot", "", kLine)                   \
  PHRASE(InkDotOf, "ink-dot-of", "time", kLine)          \
  PHRASE(InkCovered, "ink-covered", "", kLine)           \
  PHRASE(InkCoveredOf, "ink-covered-of", "", kLine)      \
  PHRASE(InkFlow, "ink-flow", "", kLine)                 \
  PHRASE(InkMolecules, "ink-molecules", "number", kLine) \
  PHRASE(InkTension, "ink-tension", "", kLine)           \
  PHRASE(InkLever, "ink-lever", "", kLine)

// A lever in tapping mode: the plot of its amplitude, its dial, and its images.
#define AFM_FOR_EACH_TAPPING_PHRASE(PHRASE)                           \
  PHRASE(PlotTitleTapping, "plot-title-tapping", "", kLine)           \
  PHRASE(PlotTitleDirect, "plot-title-tapping-direct", "", kLine)     \
  PHRASE(SwingAmplitude, "swing-amplitude", "", kLine)                \
  PHRASE(SwingPhase, "swing-phase", "", kLine)                        \
  PHRASE(SwingState, "swing-state", "", kLine)                        \
  PHRASE(SwingAttractive, "swing-attractive", "", kLine)              \
  PHRASE(SwingRepulsive, "swing-repulsive", "", kLine)                \
  PHRASE(SwingFree, "swing-free", "", kLine)                          \
  PHRASE(FeltForce, "felt-force", "", kLine)                          \
  PHRASE(FeltMeanForce, "felt-mean-force", "", kLine)                 \
  PHRASE(FeltBehindTank, "felt-behind-tank", "joules watts", kLine)   \
  PHRASE(DialTitle, "dial-title", "", kLine)                          \
  PHRASE(DialBoth, "dial-both", "", kLine)                            \
  PHRASE(DialOne, "dial-one", "", kLine)                              \
  PHRASE(DialNow, "dial-now", "", kLine)                              \
  PHRASE(DialEdge, "dial-edge", "", kLine)                            \
  PHRASE(ScanInContact, "scan-in-contact", "", kLine)                 \
  PHRASE(ScanInTapping, "scan-in-tapping", "length", kLine)           \
  PHRASE(ScanPhase, "scan-phase", "low high", kLine)                  \
  PHRASE(ScanAmplitudeError, "scan-amplitude-error", "length", kLine) \
  PHRASE(ScanEnergy, "scan-energy", "energy", kLine)                  \
  PHRASE(ScanAmplitude, "scan-amplitude", "", kLine)                  \
  PHRASE(ScanFreeAmplitude, "scan-free-amplitude", "", kLine)         \
  PHRASE(ScanDriveFrequency, "scan-drive", "", kLine)                 \
  PHRASE(CauseLostSwing, "scan-cause-lost-swing", "", kLine)          \
  PHRASE(CauseSwingInFlight, "scan-cause-swing-in-flight", "", kLine)

// A force map on the panel, and what is felt of it. Rows as in exhibit/words/phrase_list.h, whose length is limited.
#define AFM_FOR_EACH_MAP_PHRASE(PHRASE)                        \
  PHRASE(ChangePixel, "change-pixel", "", kLine)               \
  PHRASE(PixelColumn, "pixel-column", "", kLine)               \
  PHRASE(PixelRow, "pixel-row", "", kLine)                     \
  PHRASE(PixelLoaded, "pixel-loaded", "", kLine)               \
  PHRASE(NoSuchPixel, "no-such-pixel", "", kLine)              \
  PHRASE(MapHeights, "map-heights", "", kLine)                 \
  PHRASE(MapModulus, "map-modulus", "", kLine)                 \
  PHRASE(MapAdhesion, "map-adhesion", "", kLine)               \
  PHRASE(MapFelt, "map-felt", "", kLine)                       \
  PHRASE(MapHere, "map-here", "modulus adhesion", kLine)       \
  PHRASE(MapHereModulus, "map-here-modulus", "modulus", kLine) \
  PHRASE(MapFilled, "map-filled", "", kLine)                   \
  PHRASE(MapDoubtful, "map-doubtful", "", kLine)               \
  PHRASE(MapBeside, "map-beside", "", kLine)                   \
  PHRASE(SliceHeight, "slice-height", "height", kLine)         \
  PHRASE(ContactDoubtful, "contact-doubtful", "", kLine)
