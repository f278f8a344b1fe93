// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every phrase of wall and report: PHRASE(enumerator, key in the files, placeholders in the order in which the code
// fills them, with "?" if optional, limit of exhibit/phrases.h). Order: Hint, scene::FaultCode, controls, Note.
#define AFM_FOR_EACH_GUIDANCE_PHRASE(PHRASE)                       \
  PHRASE(ChooseSample, "choose-sample", kControlPlaces, kLine)     \
  PHRASE(Lift, "lift", kControlPlaces, kLine)                      \
  PHRASE(TurnOn, "turn-on", kControlPlaces, kLine)                 \
  PHRASE(TurnOnAndHold, "turn-on-and-hold", kControlPlaces, kLine) \
  PHRASE(ComingOn, "coming-on", kControlPlaces, kLine)             \
  PHRASE(GoingOff, "going-off", kControlPlaces, kLine)             \
  PHRASE(MoveDown, "move-down", kControlPlaces, kLine)             \
  PHRASE(PressOn, "press-on", kControlPlaces, kLine)               \
  PHRASE(Pressed, "pressed", kControlPlaces, kLine)                \
  PHRASE(MoveUp, "move-up", kControlPlaces, kLine)                 \
  PHRASE(LetGo, "let-go", kControlPlaces, kLine)                   \
  PHRASE(GoBeside, "go-beside", kControlPlaces, kLine)             \
  PHRASE(PushAside, "push-aside", kControlPlaces, kLine)           \
  PHRASE(TakeSwing, "take-swing", kControlPlaces, kLine)           \
  PHRASE(GiveSwing, "give-swing", kControlPlaces, kLine)           \
  PHRASE(SwingsFree, "swings-free", kControlPlaces, kLine)         \
  PHRASE(PressToGoOn, "press-to-go-on", kControlPlaces, kLine)     \
  PHRASE(ServoEnded, "servo-ended", kControlPlaces, kLine)         \
  PHRASE(ForceOff, "force-off", "", kLine)                         \
  PHRASE(RendererDied, "renderer-died", "", kLine)                 \
  PHRASE(RendererHung, "renderer-hung", "", kLine)                 \
  PHRASE(NotFinite, "not-finite", "", kLine)                       \
  PHRASE(LateTick, "late-tick", "", kLine)                         \
  PHRASE(VelocityTrip, "velocity-trip", "", kLine)                 \
  PHRASE(DeviceError, "device-error", "", kLine)                   \
  PHRASE(ServoSilent, "servo-silent", "", kLine)                   \
  PHRASE(DeadManReleased, "dead-man-released", "", kLine)          \
  PHRASE(MotorsHot, "motors-hot", "", kLine)                       \
  PHRASE(EnergyExceeded, "energy-exceeded", "", kLine)             \
  PHRASE(OutOfWorkspace, "out-of-workspace", "", kLine)            \
  PHRASE(StopPressed, "stop-pressed", "", kLine)                   \
  PHRASE(PictureUnseen, "picture-unseen", "", kLine)               \
  PHRASE(MouseUp, "mouse-up", "", kLine)                           \
  PHRASE(MouseDown, "mouse-down", "", kLine)                       \
  PHRASE(MouseTurnOn, "mouse-turn-on", "", kLine)                  \
  PHRASE(PenUp, "pen-up", "", kLine)                               \
  PHRASE(PenDown, "pen-down", "", kLine)                           \
  PHRASE(PenTurnOn, "pen-turn-on", "", kLine)                      \
  PHRASE(GripUp, "grip-up", "", kLine)                             \
  PHRASE(GripDown, "grip-down", "", kLine)                         \
  PHRASE(GripTurnOn, "grip-turn-on", "", kLine)                    \
  PHRASE(GamepadUp, "gamepad-up", "", kLine)                       \
  PHRASE(GamepadDown, "gamepad-down", "", kLine)                   \
  PHRASE(GamepadTurnOn, "gamepad-turn-on", "", kLine)              \
  PHRASE(DeviceUp, "device-up", "", kLine)                         \
  PHRASE(DeviceDown, "device-down", "", kLine)                     \
  PHRASE(DeviceTurnOn, "device-turn-on", "", kLine)                \
  PHRASE(SimulatedUp, "simulated-up", "", kLine)                   \
  PHRASE(SimulatedDown, "simulated-down", "", kLine)               \
  PHRASE(SimulatedTurnOn, "simulated-turn-on", "", kLine)          \
  PHRASE(MouseChoose, "mouse-choose", "", kLine)                   \
  PHRASE(WandChoose, "wand-choose", "", kLine)                     \
  PHRASE(AllKeys, "keys", "", kLine)                               \
  PHRASE(LeaveJourney, "leave-journey", "", kLine)                 \
  PHRASE(LeaveAnalogy, "leave-analogy", "", kLine)                 \
  PHRASE(ChangeParameters, "change-parameters", "", kLine)         \
  PHRASE(ReplayedMoment, "replayed-moment", "sample time", kLine)  \
  PHRASE(SnappedIn, "snapped-in", "", kLine)                       \
  PHRASE(BeamBends, "beam-bends", "", kLine)                       \
  PHRASE(AdhesionHolds, "adhesion-holds", "", kLine)               \
  PHRASE(Released, "released", "", kLine)                          \
  PHRASE(AllSamples, "all-samples", "", kLine)                     \
  PHRASE(OtherParameters, "other-parameters", "", kLine)

// Banner: states in the order of scene::ServoState, and Stopped; places of the journey from the bench on; scales.
#define AFM_FOR_EACH_BANNER_PHRASE(PHRASE)                            \
  PHRASE(StateOff, "state-off", "", kLine)                            \
  PHRASE(StateArming, "state-arming", "", kLine)                      \
  PHRASE(StateOn, "state-on", "", kLine)                              \
  PHRASE(StateReleasing, "state-releasing", "", kLine)                \
  PHRASE(StateFault, "state-fault", "", kLine)                        \
  PHRASE(StateStopped, "state-stopped", "", kLine)                    \
  PHRASE(NotRealTime, "not-real-time", "", kLine)                     \
  PHRASE(RealTime, "real-time", "", kLine)                            \
  PHRASE(SlowMotion, "slow-motion", "factor", kLine)                  \
  PHRASE(Journey, "journey", "place", kLine)                          \
  PHRASE(PlaceBench, "place-bench", "", kLine)                        \
  PHRASE(PlaceHead, "place-head", "", kLine)                          \
  PHRASE(PlaceHolder, "place-holder", "", kLine)                      \
  PHRASE(PlaceChip, "place-chip", "", kLine)                          \
  PHRASE(PlaceCantilever, "place-cantilever", "", kLine)              \
  PHRASE(PlaceTip, "place-tip", "", kLine)                            \
  PHRASE(PlaceApex, "place-apex", "", kLine)                          \
  PHRASE(PlaceGap, "place-gap", "", kLine)                            \
  PHRASE(PlaceAtoms, "place-atoms", "", kLine)                        \
  PHRASE(CompanionHair, "companion-hair", "", kLine)                  \
  PHRASE(CompanionCell, "companion-cell", "", kLine)                  \
  PHRASE(CompanionVirus, "companion-virus", "", kLine)                \
  PHRASE(CompanionDna, "companion-dna", "", kLine)                    \
  PHRASE(TrueScale, "true-scale", "length", kLine)                    \
  PHRASE(SampleScale, "sample-scale", "length", kLine)                \
  PHRASE(LeverScale, "lever-scale", "length", kLine)                  \
  PHRASE(TipScale, "tip-scale", "length", kLine)                      \
  PHRASE(DeflectionScale, "deflection-scale", "factor", kLine)        \
  PHRASE(HandScale, "hand-scale", "", kLine)                          \
  PHRASE(ScaleCommon, "scale-common", "", kLine)                      \
  PHRASE(ScaleFit, "scale-fit", "", kLine)                            \
  PHRASE(ScaleCompressed, "scale-compressed", "", kLine)              \
  PHRASE(ScaleAtoms, "scale-atoms", "", kLine)                        \
  PHRASE(ScaleParticles, "scale-particles", "", kLine)                \
  PHRASE(ForceLimit, "force-limit", "", kLine)                        \
  PHRASE(WhileTurnOnHeld, "while-turn-on-held", "device", kLine)      \
  PHRASE(Servo, "servo", "", kLine)                                   \
  PHRASE(ServoRate, "servo-rate", "rate class", kLine)                \
  PHRASE(ServoLateness, "servo-lateness", "late missed ticks", kLine) \
  PHRASE(Motors, "motors", "", kLine)                                 \
  PHRASE(MotorsWarm, "motors-warm", "heat", kLine)                    \
  PHRASE(MotorsForce, "motors-force", "gain", kLine)                  \
  PHRASE(Picture, "picture", "", kLine)                               \
  PHRASE(PictureQuality, "picture-quality", "percent samples", kLine) \
  PHRASE(PictureBudget, "picture-budget", "time", kLine)              \
  PHRASE(PictureOverBudget, "picture-over-budget", "time budget", kLine)

// A wall of several machines: its missing parts; and a microscope that a program controls.
#define AFM_FOR_EACH_CLUSTER_PHRASE(PHRASE)          \
  PHRASE(NodeMissing, "node-missing", "node", kLine) \
  PHRASE(MasterMissing, "master-missing", "", kLine) \
  PHRASE(Served, "served", "", kLine)

// Plots and panels of values, labels in the scene, the depth meter, the test pattern.
#define AFM_FOR_EACH_PANEL_PHRASE(PHRASE)                                \
  PHRASE(PlotTitle, "plot-title", "", kLine)                             \
  PHRASE(PlotTitleAll, "plot-title-all", "", kLine)                      \
  PHRASE(PlotApproach, "plot-approach", "", kLine)                       \
  PHRASE(PlotRetract, "plot-retract", "", kLine)                         \
  PHRASE(PlotPredicted, "plot-predicted", "", kLine)                     \
  PHRASE(StageLift, "stage-lift", "", kLine)                             \
  PHRASE(StageApproach, "stage-approach", "", kLine)                     \
  PHRASE(StageNear, "stage-near", "", kLine)                             \
  PHRASE(StageSnapIn, "stage-snap-in", "", kLine)                        \
  PHRASE(StagePress, "stage-press", "", kLine)                           \
  PHRASE(StageRetract, "stage-retract", "", kLine)                       \
  PHRASE(StageAdhesion, "stage-adhesion", "", kLine)                     \
  PHRASE(StageFree, "stage-free", "", kLine)                             \
  PHRASE(CueSnapIn, "cue-snap-in", "force", kLine)                       \
  PHRASE(CuePullOff, "cue-pull-off", "force", kLine)                     \
  PHRASE(JourneyGap, "journey-gap", "gap", kLine)                        \
  PHRASE(NoSample, "no-sample", "", kLine)                               \
  PHRASE(NoSampleAdvice, "no-sample-advice", "choose?", kLine)           \
  PHRASE(TipAndMedium, "tip-and-medium", "tip medium", kLine)            \
  PHRASE(TitleAndMedium, "title-and-medium", "sample medium", kLine)     \
  PHRASE(TipRadius, "tip-radius", "", kLine)                             \
  PHRASE(SpringConstant, "spring-constant", "", kLine)                   \
  PHRASE(HamakerConstant, "hamaker-constant", "", kLine)                 \
  PHRASE(SurfaceEnergy, "surface-energy", "", kLine)                     \
  PHRASE(WorkOfAdhesion, "work-of-adhesion", "", kLine)                  \
  PHRASE(ReducedModulus, "reduced-modulus", "", kLine)                   \
  PHRASE(AtomicDistance, "atomic-distance", "", kLine)                   \
  PHRASE(Rigid, "rigid", "", kLine)                                      \
  PHRASE(ForceLaw, "force-law", "", kLine)                               \
  PHRASE(AutomaticLaw, "automatic-law", "law", kLine)                    \
  PHRASE(LawOfRecording, "law-of-recording", "", kLine)                  \
  PHRASE(RecordedBy, "recorded-by", "instrument", kLine)                 \
  PHRASE(LawSuits, "law-suits", "tabor regime", kLine)                   \
  PHRASE(OtherLawSuits, "other-law-suits", "tabor regime law", kLine)    \
  PHRASE(ChangedFrom, "changed-from", "value", kLine)                    \
  PHRASE(Estimated, "estimated", "source", kLine)                        \
  PHRASE(SnapInAndPullOff, "snap-in-and-pull-off", "", kLine)            \
  PHRASE(JumpsOfSwing, "jumps-of-swing", "", kLine)                      \
  PHRASE(AtHeights, "at-heights", "snap-in pull-off", kLine)             \
  PHRASE(LoopEnergy, "loop-energy", "", kLine)                           \
  PHRASE(HysteresisBelow, "hysteresis-below", "k", kLine)                \
  PHRASE(NoHysteresisAbove, "no-hysteresis-above", "k", kLine)           \
  PHRASE(HysteresisAlways, "hysteresis-always", "", kLine)               \
  PHRASE(ForceOnTip, "force-on-tip", "", kLine)                          \
  PHRASE(LeverBentUp, "lever-bent-up", "deflection", kLine)              \
  PHRASE(LeverBentDown, "lever-bent-down", "deflection", kLine)          \
  PHRASE(LeverStraight, "lever-straight", "", kLine)                     \
  PHRASE(Results, "results", "", kLine)                                  \
  PHRASE(NoJumps, "no-jumps", "", kLine)                                 \
  PHRASE(NoJumpsBecause, "no-jumps-because", "law", kLine)               \
  PHRASE(ResultHeights, "result-heights", "snap-in pull-off law", kLine) \
  PHRASE(NoteSnapIn, "note-snap-in", "force z", kLine)                   \
  PHRASE(NotePullOff, "note-pull-off", "force z", kLine)                 \
  PHRASE(NoteLoop, "note-loop", "energy", kLine)                         \
  PHRASE(NoteNoJump, "note-no-jump", "", kLine)                          \
  PHRASE(NoteTabor, "note-tabor", "tabor regime law", kLine)             \
  PHRASE(NoteNoHysteresis, "note-no-hysteresis", "k", kLine)             \
  PHRASE(NoteDrawnBy, "note-drawn-by", "device", kLine)                  \
  PHRASE(ParametersLoaded, "parameters-loaded", "", kLine)               \
  PHRASE(ParametersWait, "parameters-wait", "", kLine)                   \
  PHRASE(ParametersApplied, "parameters-applied", "", kLine)             \
  PHRASE(ParametersRefused, "parameters-refused", "", kLine)             \
  PHRASE(ParametersHeld, "parameters-held", "", kLine)                   \
  PHRASE(NoSuchParameters, "no-such-parameters", "", kLine)              \
  PHRASE(ButtonReset, "button-reset", "", kLine)                         \
  PHRASE(ButtonClose, "button-close", "", kLine)                         \
  PHRASE(AnalogySpring, "analogy-spring", "", kLine)                     \
  PHRASE(AnalogyMagnet, "analogy-magnet", "", kLine)                     \
  PHRASE(AnalogyPlate, "analogy-plate", "", kLine)                       \
  PHRASE(HeightsTimes, "heights-times", "factor", kLine)                 \
  PHRASE(Depth, "depth", "near far near-angle far-angle", kLine)         \
  PHRASE(DepthBringToWall, "depth-bring-to-wall", "", kLine)             \
  PHRASE(DepthNarrowEyes, "depth-narrow-eyes", "", kLine)                \
  PHRASE(DepthWideEyes, "depth-wide-eyes", "distance", kLine)            \
  PHRASE(PatternSquare, "pattern-square", "length", kLine)               \
  PHRASE(PatternEyes, "pattern-eyes", "", kLine)                         \
  PHRASE(PatternOneEye, "pattern-one-eye", "", kLine)                    \
  PHRASE(PatternRuler, "pattern-ruler", "distance", kLine)

// Friction loop.
#define AFM_FOR_EACH_FRICTION_PHRASE(PHRASE)                        \
  PHRASE(FrictionTitle, "friction-title", "", kLine)                \
  PHRASE(FrictionOff, "friction-off", "", kLine)                    \
  PHRASE(FrictionAdvice, "friction-advice", "", kLine)              \
  PHRASE(FrictionClosed, "friction-closed", "law", kLine)           \
  PHRASE(FrictionZoomed, "friction-zoomed", "shown periods", kLine) \
  PHRASE(FrictionNow, "friction-now", "", kLine)                    \
  PHRASE(FrictionLeft, "friction-left", "", kLine)                  \
  PHRASE(FrictionRight, "friction-right", "", kLine)                \
  PHRASE(FrictionHalfWidth, "friction-half-width", "", kLine)       \
  PHRASE(FrictionOffset, "friction-offset", "", kLine)              \
  PHRASE(FrictionSlope, "friction-slope", "", kLine)

// Scan images and settings; artefacts, in the order of physics::ScanArtefact, whose names are the ends of the keys.
#define AFM_FOR_EACH_SCAN_PHRASE(PHRASE)                               \
  PHRASE(ScanTitle, "scan-title", "sample", kLine)                     \
  PHRASE(ScanSubtitle, "scan-subtitle", "side rate line lines", kLine) \
  PHRASE(ScanTrace, "scan-trace", "", kLine)                           \
  PHRASE(ScanRetrace, "scan-retrace", "", kLine)                       \
  PHRASE(ScanTraceShort, "scan-trace-short", "", kLine)                \
  PHRASE(ScanRetraceShort, "scan-retrace-short", "", kLine)            \
  PHRASE(ScanError, "scan-error", "force", kLine)                      \
  PHRASE(ScanLateral, "scan-lateral", "force", kLine)                  \
  PHRASE(ScanNewestLine, "scan-newest-line", "", kLine)                \
  PHRASE(ScanSetpoint, "scan-setpoint", "", kLine)                     \
  PHRASE(ScanGain, "scan-gain", "", kLine)                             \
  PHRASE(ScanRate, "scan-rate", "", kLine)                             \
  PHRASE(ScanNoise, "scan-noise", "", kLine)                           \
  PHRASE(ScanDrift, "scan-drift", "", kLine)                           \
  PHRASE(ScanSecondApex, "scan-second-apex", "", kLine)                \
  PHRASE(ScanOneApex, "scan-one-apex", "", kLine)                      \
  PHRASE(ScanNoteKeys, "scan-note-keys", "", kLine)                    \
  PHRASE(ScanNoteTruth, "scan-note-truth", "", kLine)                  \
  PHRASE(ScanSample, "scan-sample", "", kLine)                         \
  PHRASE(ScanTipShape, "scan-tip-shape", "", kLine)                    \
  PHRASE(ScanTipTrue, "scan-tip-true", "", kLine)                      \
  PHRASE(ScanTipFound, "scan-tip-found", "", kLine)                    \
  PHRASE(ScanTruthSubtitle, "scan-truth-subtitle", "percent", kLine)   \
  PHRASE(ScanHeight, "scan-height", "", kLine)                         \
  PHRASE(ScanDeflection, "scan-deflection", "", kLine)                 \
  PHRASE(ScanHandHeight, "scan-hand-height", "", kLine)                \
  PHRASE(ScanLateralX, "scan-lateral-x", "force", kLine)               \
  PHRASE(ScanLateralY, "scan-lateral-y", "force", kLine)               \
  PHRASE(ScanByHand, "scan-by-hand", "side percent", kLine)            \
  PHRASE(ScanByHandOpen, "scan-by-hand-open", "side percent", kLine)   \
  PHRASE(ScanHandLift, "scan-hand-lift", "", kLine)                    \
  PHRASE(ScanHandHold, "scan-hand-hold", "", kLine)                    \
  PHRASE(ScanHandLed, "scan-hand-led", "", kLine)                      \
  PHRASE(ScanHandLost, "scan-hand-lost", "", kLine)                    \
  PHRASE(ScanHandTouch, "scan-hand-touch", "", kLine)                  \
  PHRASE(ScanHandLiftOnce, "scan-hand-lift-once", "", kLine)           \
  PHRASE(ScanHandPaints, "scan-hand-paints", "", kLine)                \
  PHRASE(CauseNone, "scan-cause-none", "", kLine)                      \
  PHRASE(CauseLostContact, "scan-cause-lost-contact", "", kLine)       \
  PHRASE(CauseRinging, "scan-cause-ringing", "", kLine)                \
  PHRASE(CauseParachuting, "scan-cause-parachuting", "", kLine)        \
  PHRASE(CauseStateFlips, "scan-cause-state-flips", "", kLine)         \
  PHRASE(CauseSaturation, "scan-cause-saturation", "", kLine)          \
  PHRASE(CauseOverload, "scan-cause-overload", "", kLine)              \
  PHRASE(CauseDoubleTip, "scan-cause-double-tip", "", kLine)           \
  PHRASE(CauseDrift, "scan-cause-drift", "", kLine)                    \
  PHRASE(CauseNoise, "scan-cause-noise", "", kLine)                    \
  PHRASE(CauseBlur, "scan-cause-blur", "", kLine)                      \
  PHRASE(CauseBluntTip, "scan-cause-blunt-tip", "", kLine)

// List of keys (F1).
#define AFM_FOR_EACH_KEY_PHRASE(PHRASE)                      \
  PHRASE(Keys, "key-list", "", kLine)                        \
  PHRASE(KeysHidden, "key-list-hide", "", kLine)             \
  PHRASE(LeftClick, "left-click", "", kLine)                 \
  PHRASE(MiddleClick, "middle-click", "", kLine)             \
  PHRASE(RightDragOrWheel, "right-drag-or-wheel", "", kLine) \
  PHRASE(KeyChoose, "key-choose", "", kLine)                 \
  PHRASE(KeyHand, "key-hand", "", kLine)                     \
  PHRASE(KeyHandOver, "key-hand-over", "", kLine)            \
  PHRASE(KeyTurnOn, "key-turn-on", "", kLine)                \
  PHRASE(KeyStop, "key-stop", "", kLine)                     \
  PHRASE(KeyParameters, "key-parameters", "", kLine)         \
  PHRASE(KeySources, "key-sources", "", kLine)               \
  PHRASE(KeyScan, "key-scan", "", kLine)                     \
  PHRASE(KeyTruth, "key-truth", "", kLine)                   \
  PHRASE(KeyFalseColours, "key-false-colours", "", kLine)    \
  PHRASE(KeyMapPicture, "key-map-picture", "", kLine)        \
  PHRASE(KeyMapVolume, "key-map-volume", "", kLine)          \
  PHRASE(KeyFriction, "key-friction", "", kLine)             \
  PHRASE(KeyStroboscope, "key-stroboscope", "", kLine)       \
  PHRASE(KeyScanHand, "key-scan-hand", "", kLine)            \
  PHRASE(KeyScanFeedback, "key-scan-feedback", "", kLine)    \
  PHRASE(KeyNextSetting, "key-next-setting", "", kLine)      \
  PHRASE(KeyChangeSetting, "key-change-setting", "", kLine)  \
  PHRASE(KeyScale, "key-scale", "", kLine)                   \
  PHRASE(KeyJourney, "key-journey", "", kLine)               \
  PHRASE(KeyAnalogy, "key-analogy", "", kLine)               \
  PHRASE(KeySay, "key-say", "", kLine)                       \
  PHRASE(KeySound, "key-sound", "", kLine)                   \
  PHRASE(KeyBlank, "key-blank", "", kLine)                   \
  PHRASE(KeyStartAgain, "key-start-again", "", kLine)        \
  PHRASE(KeyHome, "key-home", "", kLine)                     \
  PHRASE(KeyTakeBack, "key-take-back", "", kLine)            \
  PHRASE(KeyPlan, "key-plan", "", kLine)                     \
  PHRASE(KeyGroove, "key-groove", "", kLine)                 \
  PHRASE(KeyHeadAcross, "key-head-across", "", kLine)        \
  PHRASE(KeyHeadHeight, "key-head-height", "", kLine)        \
  PHRASE(KeyHeadDistance, "key-head-distance", "", kLine)    \
  PHRASE(KeyPanels, "key-panels", "", kLine)                 \
  PHRASE(KeySwapEyes, "key-swap-eyes", "", kLine)            \
  PHRASE(KeyStereoMode, "key-stereo-mode", "", kLine)        \
  PHRASE(KeyEyeDistance, "key-eye-distance", "", kLine)      \
  PHRASE(KeyTestPattern, "key-test-pattern", "", kLine)      \
  PHRASE(KeyContactToWall, "key-contact-to-wall", "", kLine) \
  PHRASE(KeyFullScreen, "key-full-screen", "", kLine)        \
  PHRASE(KeySavePicture, "key-save-picture", "", kLine)      \
  PHRASE(KeyEnd, "key-end", "", kLine)

// report.html.
#define AFM_FOR_EACH_REPORT_PHRASE(PHRASE)                                                  \
  PHRASE(ReportTitle, "report-title", "", kLine)                                            \
  PHRASE(ReportHeading, "report-heading", "count", kLine)                                   \
  PHRASE(ReportHeadingOne, "report-heading-one", "", kLine)                                 \
  PHRASE(ReportRun, "report-run", "version time hand speed frames size gpu", kParagraph)    \
  PHRASE(ReportCurves, "report-curves", "", kLine)                                          \
  PHRASE(ReportCurvesNote, "report-curves-note", "", kParagraph)                            \
  PHRASE(ReportZAxis, "report-z-axis", "", kLine)                                           \
  PHRASE(ReportForceAxis, "report-force-axis", "", kLine)                                   \
  PHRASE(ReportApproach, "report-approach", "sample", kLine)                                \
  PHRASE(ReportRetract, "report-retract", "sample", kLine)                                  \
  PHRASE(ReportAllCurves, "report-all-curves", "", kLine)                                   \
  PHRASE(ReportAmplitudeAxis, "report-amplitude-axis", "", kLine)                           \
  PHRASE(ReportTappedCurvesNote, "report-tapped-curves-note", "", kParagraph)               \
  PHRASE(ReportNearCurves, "report-near-curves", "", kLine)                                 \
  PHRASE(ReportTable, "report-table", "", kLine)                                            \
  PHRASE(ReportSample, "report-sample", "", kLine)                                          \
  PHRASE(ReportQuantity, "report-quantity", "", kLine)                                      \
  PHRASE(ReportCalculation, "report-calculation", "", kLine)                                \
  PHRASE(ReportSimulation, "report-simulation", "", kLine)                                  \
  PHRASE(ReportVersusCalculation, "report-versus-calculation", "", kLine)                   \
  PHRASE(ReportSampled, "report-sampled", "", kLine)                                        \
  PHRASE(ReportExperiment, "report-experiment", "", kLine)                                  \
  PHRASE(ReportVersusExperiment, "report-versus-experiment", "", kLine)                     \
  PHRASE(ReportNoJumps, "report-no-jumps", "", kParagraph)                                  \
  PHRASE(ReportRecording, "report-recording", "snap-in pull-off felt recorded", kParagraph) \
  PHRASE(ReportSnapsIn, "report-snaps-in", "", kLine)                                       \
  PHRASE(ReportNoSnapIn, "report-no-snap-in", "", kLine)                                    \
  PHRASE(ReportPullsOff, "report-pulls-off", "", kLine)                                     \
  PHRASE(ReportNoPullOff, "report-no-pull-off", "", kLine)                                  \
  PHRASE(ReportTableNote, "report-table-note", "", kParagraph)                              \
  PHRASE(ReportTappedTableNote, "report-tapped-table-note", "", kParagraph)                 \
  PHRASE(ReportWall, "report-wall", "", kLine)                                              \
  PHRASE(ReportWallNote, "report-wall-note", "", kParagraph)                                \
  PHRASE(CaptionChoosing, "caption-choosing", "", kParagraph)                               \
  PHRASE(CaptionSnapIn, "caption-snap-in", "", kParagraph)                                  \
  PHRASE(CaptionPressed, "caption-pressed", "", kParagraph)                                 \
  PHRASE(CaptionAdhesion, "caption-adhesion", "", kParagraph)                               \
  PHRASE(CaptionFree, "caption-free", "", kParagraph)                                       \
  PHRASE(CaptionAll, "caption-all", "", kParagraph)                                         \
  PHRASE(CaptionRepelled, "caption-repelled", "", kParagraph)                               \
  PHRASE(CaptionTapped, "caption-tapped", "", kParagraph)                                   \
  PHRASE(CaptionLastRepelled, "caption-last-repelled", "", kParagraph)                      \
  PHRASE(CaptionSwingsFree, "caption-swings-free", "", kParagraph)                          \
  PHRASE(CaptionAmplitudes, "caption-amplitudes", "", kParagraph)                           \
  PHRASE(CaptionVaried, "caption-varied", "sample", kParagraph)                             \
  PHRASE(CaptionJourney, "caption-journey", "", kParagraph)                                 \
  PHRASE(ReportTiming, "report-timing", "", kLine)                                          \
  PHRASE(ReportWhat, "report-what", "", kLine)                                              \
  PHRASE(ReportMaximum, "report-maximum", "", kLine)                                        \
  PHRASE(ReportWakeUp, "report-wake-up", "", kLine)                                         \
  PHRASE(ReportWork, "report-work", "", kLine)                                              \
  PHRASE(ReportFrame, "report-frame", "", kLine)                                            \
  PHRASE(ReportServo, "report-servo", "rate policy pages ticks missed lost", kParagraph)    \
  PHRASE(ReportNotRealTime, "report-not-real-time", "policy", kLine)                        \
  PHRASE(ReportPagesLocked, "report-pages-locked", "", kLine)                               \
  PHRASE(ReportPagesNotLocked, "report-pages-not-locked", "", kLine)

// Language: as in HTML's lang attribute. DecimalMark: separates the digits of a number.
#define AFM_FOR_EACH_PHRASE(PHRASE)              \
  PHRASE(Language, "language", "", kLine)        \
  PHRASE(DecimalMark, "decimal-mark", "", kLine) \
  AFM_FOR_EACH_GUIDANCE_PHRASE(PHRASE)           \
  AFM_FOR_EACH_BANNER_PHRASE(PHRASE)             \
  AFM_FOR_EACH_CLUSTER_PHRASE(PHRASE)            \
  AFM_FOR_EACH_PANEL_PHRASE(PHRASE)              \
  AFM_FOR_EACH_TAPPING_PHRASE(PHRASE)            \
  AFM_FOR_EACH_SOFT_PHRASE(PHRASE)               \
  AFM_FOR_EACH_INK_PHRASE(PHRASE)                \
  AFM_FOR_EACH_MAP_PHRASE(PHRASE)                \
  AFM_FOR_EACH_FRICTION_PHRASE(PHRASE)           \
  AFM_FOR_EACH_PARTICLE_PHRASE(PHRASE)           \
  AFM_FOR_EACH_SCAN_PHRASE(PHRASE)               \
  AFM_FOR_EACH_KEY_PHRASE(PHRASE)                \
  AFM_FOR_EACH_SOUND_PHRASE(PHRASE)              \
  AFM_FOR_EACH_LESSON_PHRASE(PHRASE)             \
  AFM_FOR_EACH_REPORT_PHRASE(PHRASE)
