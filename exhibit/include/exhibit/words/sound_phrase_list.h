// SPDX-License-Identifier: Apache-2.0
#pragma once

// Captions and speech, in the order of HeardEvent; numbers with units, singular and plural, pico to micro; the key Y.
#define AFM_FOR_EACH_SOUND_PHRASE(PHRASE)                                            \
  PHRASE(HeardSnapIn, "heard-snap-in", kEventPlaces, kLine)                          \
  PHRASE(HeardPullOff, "heard-pull-off", kEventPlaces, kLine)                        \
  PHRASE(HeardSlip, "heard-slip", kEventPlaces, kLine)                               \
  PHRASE(HeardTouch, "heard-touch", kEventPlaces, kLine)                             \
  PHRASE(HeardForceOn, "heard-force-on", kEventPlaces, kLine)                        \
  PHRASE(HeardForceOff, "heard-force-off", kEventPlaces, kLine)                      \
  PHRASE(HeardFault, "heard-fault", kEventPlaces, kLine)                             \
  PHRASE(HeardSample, "heard-sample", kEventPlaces, kLine)                           \
  PHRASE(HeardReady, "heard-ready", kEventPlaces, kLine)                             \
  PHRASE(HeardScanLine, "heard-scan-line", kEventPlaces, kLine)                      \
  PHRASE(HeardParticleTouched, "heard-particle-touched", kEventPlaces, kLine)        \
  PHRASE(HeardParticleGave, "heard-particle-gave", kEventPlaces, kLine)              \
  PHRASE(HeardParticleLost, "heard-particle-lost", kEventPlaces, kLine)              \
  PHRASE(HeardParticleRiddenOver, "heard-particle-ridden-over", kEventPlaces, kLine) \
  PHRASE(HeardParticleDragged, "heard-particle-dragged", kEventPlaces, kLine)        \
  PHRASE(HeardParticleTorn, "heard-particle-torn", kEventPlaces, kLine)              \
  PHRASE(HeardPushTakenBack, "heard-push-taken-back", kEventPlaces, kLine)           \
  PHRASE(HeardParticlesPutBack, "heard-particles-put-back", kEventPlaces, kLine)     \
  PHRASE(HeardPatternDone, "heard-pattern-done", kEventPlaces, kLine)                \
  PHRASE(HeardJumpToRepulsion, "heard-jump-to-repulsion", kEventPlaces, kLine)       \
  PHRASE(HeardJumpToAttraction, "heard-jump-to-attraction", kEventPlaces, kLine)     \
  PHRASE(SaySnapIn, "say-snap-in", kEventPlaces, kLine)                              \
  PHRASE(SayPullOff, "say-pull-off", kEventPlaces, kLine)                            \
  PHRASE(SaySlip, "say-slip", kEventPlaces, kLine)                                   \
  PHRASE(SayTouch, "say-touch", kEventPlaces, kLine)                                 \
  PHRASE(SayForceOn, "say-force-on", kEventPlaces, kLine)                            \
  PHRASE(SayForceOff, "say-force-off", kEventPlaces, kLine)                          \
  PHRASE(SayFault, "say-fault", kEventPlaces, kLine)                                 \
  PHRASE(SaySample, "say-sample", kEventPlaces, kLine)                               \
  PHRASE(SayReady, "say-ready", kEventPlaces, kLine)                                 \
  PHRASE(SayScanLine, "say-scan-line", kEventPlaces, kLine)                          \
  PHRASE(SayParticleTouched, "say-particle-touched", kEventPlaces, kLine)            \
  PHRASE(SayParticleGave, "say-particle-gave", kEventPlaces, kLine)                  \
  PHRASE(SayParticleLost, "say-particle-lost", kEventPlaces, kLine)                  \
  PHRASE(SayParticleRiddenOver, "say-particle-ridden-over", kEventPlaces, kLine)     \
  PHRASE(SayParticleDragged, "say-particle-dragged", kEventPlaces, kLine)            \
  PHRASE(SayParticleTorn, "say-particle-torn", kEventPlaces, kLine)                  \
  PHRASE(SayPushTakenBack, "say-push-taken-back", kEventPlaces, kLine)               \
  PHRASE(SayParticlesPutBack, "say-particles-put-back", kEventPlaces, kLine)         \
  PHRASE(SayPatternDone, "say-pattern-done", kEventPlaces, kLine)                    \
  PHRASE(SayJumpToRepulsion, "say-jump-to-repulsion", kEventPlaces, kLine)           \
  PHRASE(SayJumpToAttraction, "say-jump-to-attraction", kEventPlaces, kLine)         \
  PHRASE(OnePiconewton, "piconewton", "number", kLine)                               \
  PHRASE(Piconewtons, "piconewtons", "number", kLine)                                \
  PHRASE(OneNanonewton, "nanonewton", "number", kLine)                               \
  PHRASE(Nanonewtons, "nanonewtons", "number", kLine)                                \
  PHRASE(OneMicronewton, "micronewton", "number", kLine)                             \
  PHRASE(Micronewtons, "micronewtons", "number", kLine)                              \
  PHRASE(OnePicometre, "picometre", "number", kLine)                                 \
  PHRASE(Picometres, "picometres", "number", kLine)                                  \
  PHRASE(OneNanometre, "nanometre", "number", kLine)                                 \
  PHRASE(Nanometres, "nanometres", "number", kLine)                                  \
  PHRASE(OneMicrometre, "micrometre", "number", kLine)                               \
  PHRASE(Micrometres, "micrometres", "number", kLine)                                \
  PHRASE(SayNoForce, "say-no-force", "", kLine)                                      \
  PHRASE(SayPull, "say-pull", "force", kLine)                                        \
  PHRASE(SayPush, "say-push", "force", kLine)                                        \
  PHRASE(SayHeight, "say-height", "height", kLine)                                   \
  PHRASE(SayDepth, "say-depth", "height", kLine)                                     \
  PHRASE(SoundOff, "sound-off", "", kLine)                                           \
  PHRASE(SoundOn, "sound-on", "", kLine)                                             \
  PHRASE(PictureShown, "picture-shown", "", kLine)                                   \
  PHRASE(PictureBlank, "picture-blank", "", kLine)
