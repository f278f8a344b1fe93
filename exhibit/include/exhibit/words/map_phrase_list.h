// SPDX-License-Identifier: Apache-2.0
#pragma once

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
