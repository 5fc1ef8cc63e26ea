// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/session.h"

#include <algorithm>
#include <utility>

#include "document/design_store.h"
#include "tools/picking.h"
#include "tools/tool_info.h"

namespace toile::studio {

Session::Session(QObject* parent) : QObject(parent), tool_(makeTool(ToolId::Select)) {
  connect(&worker_, &PatternWorker::answered, this, &Session::take);
  connect(&worker_, &PatternWorker::workingChanged, this, &Session::patternStateChanged);
}

Session::~Session() = default;

void Session::start(const Document& document, const std::filesystem::path& path,
                    const QString& stepName) {
  tool_ = makeTool(ToolId::Select);
  history_.emplace(Step{stepName, QStringLiteral("body"), document, QDateTime::currentDateTime()});
  path_ = origin_ = path;
  saved_ = path.empty() ? nullptr : document.design;
  preview_.reset();
  selection_ = hover_ = {};
  pattern_.reset();
  fullPattern_.reset();
  strains_.reset();
  ghosts_.clear();
  pieces_.reset();
  pieceIds_.clear();
  patternError_.reset();
  patternIsCurrent_ = false;
  middle_ = middleLines(*document.model);
  Q_EMIT workStarted();
  showDocument(document);
  Q_EMIT historyChanged();
  Q_EMIT selectionChanged();
  Q_EMIT patternChanged();
  Q_EMIT toolChanged();
  worker_.ask(document, AskedFor::State);
}

void Session::startRecovered(const Document& document, const std::filesystem::path& backup,
                             const std::filesystem::path& original) {
  start(document, backup, tr("Recovered work"));
  path_ = original;
  saved_ = std::make_shared<const Design>();
  Q_EMIT historyChanged();
}

void Session::putOn(const QString& stepName, const Document& document) {
  setTool(ToolId::Select);
  tool_->leave(*this);
  preview_.reset();
  select({});
  history_->push({stepName, QStringLiteral("body"), document, QDateTime::currentDateTime()});
  patternIsCurrent_ = false;
  takeBody();
  showDocument(document);
  Q_EMIT historyChanged();
  worker_.ask(document, AskedFor::State);
}

void Session::takeBody() {
  middle_ = middleLines(*document().model);
  pattern_.reset();
  pieces_.reset();
  pieceIds_.clear();
  Q_EMIT bodyChanged();
  Q_EMIT patternChanged();
}

void Session::showDocument(const Document& document) {
  for (const Error& error : lines_.update(document)) {
    Q_EMIT told(QString::fromStdString(error.message));
  }
  Q_EMIT linesChanged();
}

const Document& Session::shown() const {
  return preview_ ? *preview_ : history_->current();
}

QString Session::title() const {
  if (!path_.empty()) return QString::fromStdString(path_.stem().string());
  const std::string& name = document().design->name;
  return name.empty() ? tr("Untitled") : QString::fromStdString(name);
}

bool Session::isUnsaved() const {
  if (saved_ == nullptr) return history_->at() > 0;
  return saved_ != document().design && !(*saved_ == *document().design);
}

Result<void> Session::save(const std::filesystem::path& path) {
  const Result<void> written = saveDesign(document(), origin_, path);
  if (!written) return written;
  path_ = path;
  saved_ = document().design;
  Q_EMIT historyChanged();
  return {};
}

void Session::undo() {
  if (history_->canUndo()) jumpTo(history_->at() - 1);
}

void Session::redo() {
  if (history_->canRedo()) jumpTo(history_->at() + 1);
}

void Session::jumpTo(std::size_t step) {
  tool_->leave(*this);
  history_->jumpTo(step);
  afterJump();
}

void Session::afterJump() {
  preview_.reset();
  patternIsCurrent_ = false;
  if (document().model != lines_.document().model) takeBody();
  showDocument(document());
  if (selection_.kind == Selection::Kind::Line && lines_.find(selection_.id) == nullptr) select({});
  Q_EMIT historyChanged();
  Q_EMIT toolMoved();
  worker_.ask(document(), AskedFor::State);
}

void Session::setTool(ToolId id) {
  if (tool_->id() != id) {
    tool_->leave(*this);
    tool_ = makeTool(id);
  }
  Q_EMIT toolChanged();
  Q_EMIT toolMoved();
}

void Session::setOptions(const DrawingOptions& options) {
  options_ = options;
  Q_EMIT toolChanged();
  Q_EMIT toolMoved();
}

void Session::setUnit(LengthUnit unit) {
  unit_ = unit;
  Q_EMIT toolChanged();
  Q_EMIT selectionChanged();
  Q_EMIT patternChanged();
}

void Session::pointer(PointerAction action, const PointerEvent& event) {
  switch (action) {
    case PointerAction::Press:
      tool_->press(event, *this);
      break;
    case PointerAction::Move:
      tool_->move(event, *this);
      break;
    case PointerAction::Release:
      tool_->release(event, *this);
      break;
    case PointerAction::DoubleClick:
      tool_->doubleClick(event, *this);
      break;
  }
  setHover(tool_->overlay(*this).hover);
  Q_EMIT toolMoved();
}

bool Session::key(ToolKey key) {
  const bool taken = tool_->key(key, *this);
  Q_EMIT toolMoved();
  return taken;
}

void Session::setToolSetting(double value) {
  tool_->set(value, *this);
  Q_EMIT toolMoved();
}

void Session::setStrainLook(const StrainLook& look) {
  if (look == strainLook_) return;
  strainLook_ = look;
  Q_EMIT strainChanged();
}

std::optional<double> Session::strainLimit() const {
  std::optional<double> least;
  if (!strains_) return least;
  for (const auto& piece : *strains_) {
    const auto limit = piece ? piece->limits.of(strainLook_.kind) : std::nullopt;
    if (limit && (!least || *limit < *least)) least = limit;
  }
  return least;
}

void Session::setPieceColours(PieceColours colours) {
  if (colours == pieceColours_) return;
  pieceColours_ = colours;
  Q_EMIT coloursChanged();
}

void Session::setGhosts(std::vector<Ghost> ghosts) {
  if (ghosts.empty() && ghosts_.empty()) return;
  ghosts_ = std::move(ghosts);
  Q_EMIT ghostsChanged();
}

std::optional<std::size_t> Session::pieceIndex(const std::string& piece) const {
  if (!fullPattern_ || !patternIsCurrent_) return std::nullopt;
  const auto& pieces = fullPattern_->cut.pieces;
  const auto found = std::ranges::find(pieces, piece, &Piece::id);
  if (found == pieces.end()) return std::nullopt;
  return static_cast<std::size_t>(found - pieces.begin());
}

void Session::openPanel(SidePanel panel, const std::string& piece) {
  Q_EMIT panelWanted(panel, piece);
}

void Session::showPlace(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
  Q_EMIT placeWanted(place, normal);
}

void Session::setHover(const Selection& hover) {
  if (hover == hover_) return;
  hover_ = hover;
  Q_EMIT hoverChanged();
}

std::optional<std::string> Session::pieceAt(const SurfacePoint& point) const {
  const auto found = pieces_ ? pieces_->pieceAt(point) : std::nullopt;
  return found ? std::optional(pieceIds_[*found]) : std::nullopt;
}

QString Session::lengthText(double mm) const {
  return studio::lengthText(mm, unit_);
}

void Session::select(const Selection& selection) {
  if (selection == selection_) return;
  selection_ = selection;
  Q_EMIT selectionChanged();
}

void Session::preview(const Document& document, bool withPattern) {
  preview_ = document;
  showDocument(document);
  if (!withPattern) return;
  patternIsCurrent_ = false;
  worker_.ask(document, AskedFor::Preview);
}

void Session::dropPreview() {
  if (!preview_) return;
  preview_.reset();
  showDocument(document());
  if (!patternIsCurrent_) worker_.ask(document(), AskedFor::State);
}

void Session::commit(const QString& name, const Document& document) {
  preview_.reset();
  history_->push({name, QString::fromLatin1(infoOf(tool_->id()).icon), document,
                  QDateTime::currentDateTime()});
  patternIsCurrent_ = false;
  showDocument(document);
  Q_EMIT historyChanged();
  worker_.ask(document, AskedFor::Step);
}

void Session::tell(const QString& sentence) {
  Q_EMIT told(sentence);
}

void Session::take(const PatternAnswer& answer) {
  const bool isOfWork = answer.document.design == document().design;
  patternError_ = answer.error;
  if (answer.pattern) {
    pattern_ = answer.pattern;
    patternIsPreview_ = answer.isPreview;
    if (!answer.isPreview) {
      fullPattern_ = pattern_;
      strains_ = answer.strains;
      pieces_ = std::make_unique<PieceFinder>(pattern_);
      pieceIds_.clear();
      for (const Piece& piece : pattern_->cut.pieces) pieceIds_.push_back(piece.id);
    }
  }
  patternIsCurrent_ = !answer.isPreview && isOfWork;
  if (answer.followed && isOfWork) {
    // The records went with their pieces: the same step, put more exactly.
    history_->amend({answer.followed, document().model});
    if (!preview_) {
      lines_.update(document());
      patternIsCurrent_ = false;
      worker_.ask(document(), AskedFor::State);
    }
  }
  Q_EMIT patternChanged();
  Q_EMIT patternStateChanged();
}

}  // namespace toile::studio
