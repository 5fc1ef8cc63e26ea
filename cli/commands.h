// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "session.h"

namespace toile::cli {

// One per file of the same name; listed in main.cpp in the order of the help text.
void addMake(CLI::App& app, Session& session);
void addCheck(CLI::App& app, Session& session);
void addUnfold(CLI::App& app, Session& session);
void addBody(CLI::App& app, Session& session);
void addDevelop(CLI::App& app, Session& session);
void addRender(CLI::App& app, Session& session);
void addStudio(CLI::App& app, Session& session);
void addScan(CLI::App& app, Session& session);
void addFit(CLI::App& app, Session& session);
void addConvert(CLI::App& app, Session& session);
void addCheckSewing(CLI::App& app, Session& session);
void addMap(CLI::App& app, Session& session);
void addNest(CLI::App& app, Session& session);
void addTransfer(CLI::App& app, Session& session);
void addWarp(CLI::App& app, Session& session);
void addBatch(CLI::App& app, Session& session);
void addGrade(CLI::App& app, Session& session);

}  // namespace toile::cli
