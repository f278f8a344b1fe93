// SPDX-License-Identifier: Apache-2.0
#pragma once

// A wall of several machines: its missing parts.
#define AFM_FOR_EACH_CLUSTER_PHRASE(PHRASE)          \
  PHRASE(NodeMissing, "node-missing", "node", kLine) \
  PHRASE(MasterMissing, "master-missing", "", kLine)
