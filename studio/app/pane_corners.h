// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace toile::studio {

class Actions;
class PatternView;
class Session;
class Viewport;

/// Puts the chips and small buttons into the corners of both panes.
void addPaneCorners(Viewport& viewport, PatternView& pattern, Session& session, Actions& actions);

}  // namespace toile::studio
