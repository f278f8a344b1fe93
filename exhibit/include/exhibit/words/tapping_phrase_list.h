// SPDX-License-Identifier: Apache-2.0
#pragma once

// A lever that taps: the plot of its amplitude, its dial, and images beside it.
#define AFM_FOR_EACH_TAPPING_PHRASE(PHRASE)                 \
  PHRASE(PlotTitleTapping, "plot-title-tapping", "", kLine) \
  PHRASE(SwingAmplitude, "swing-amplitude", "", kLine)      \
  PHRASE(SwingPhase, "swing-phase", "", kLine)              \
  PHRASE(SwingState, "swing-state", "", kLine)              \
  PHRASE(SwingAttractive, "swing-attractive", "", kLine)    \
  PHRASE(SwingRepulsive, "swing-repulsive", "", kLine)      \
  PHRASE(SwingFree, "swing-free", "", kLine)                \
  PHRASE(DialTitle, "dial-title", "", kLine)                \
  PHRASE(DialBoth, "dial-both", "", kLine)                  \
  PHRASE(DialOne, "dial-one", "", kLine)                    \
  PHRASE(DialNow, "dial-now", "", kLine)                    \
  PHRASE(DialEdge, "dial-edge", "", kLine)                  \
  PHRASE(ScanInContact, "scan-in-contact", "", kLine)
