// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/units.h"
#include "document/history.h"
#include "document/piece_finder.h"
#include "jobs/pattern_worker.h"
#include "tools/tool.h"

namespace toile::studio {

/// How strain is shown, in both panes alike.
struct StrainLook {
  bool on = false;
  StrainKind kind = StrainKind::Area;
  double scale = 0.2;  ///< end of the colours, either way
  friend bool operator==(const StrainLook&, const StrainLook&) = default;
};

/// What tells pieces apart where strain is not shown.
enum class PieceColours { Fabric, Piece };

/// A line that is proposed and not drawn yet, in both panes.
struct Ghost {
  std::vector<Eigen::Vector3d> points, normals;
  std::string piece;                  ///< on whose plane `flat` lies
  std::vector<Eigen::Vector2d> flat;  ///< mm
  CurveKind kind = CurveKind::Dart;
  QString label;
};

/// What stands above the lists: what is selected, or something that was asked for.
enum class SidePanel { Selection, Darts, Developable, Fabrics };

/// One work: document, history, selection, tool and live pattern. What windows show, they read
/// from here, and they hear of changes by signals; they hold no state of the work themselves.
class Session final : public QObject, public ToolHost {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);
  ~Session() override;

  // ---- the work
  /// Begins with a document. An empty path means: not saved yet.
  void start(const Document& document, const std::filesystem::path& path, const QString& stepName);
  /// Goes on with work that was left behind: it counts as unsaved.
  void startRecovered(const Document& document, const std::filesystem::path& backup,
                      const std::filesystem::path& original);
  /// Another body below the work: a step like any other, so that undo goes back to the one before.
  void putOn(const QString& stepName, const Document& document);
  /// From where relative names of models count.
  [[nodiscard]] const std::filesystem::path& origin() const { return origin_; }
  [[nodiscard]] bool hasWork() const { return history_.has_value(); }
  [[nodiscard]] const History& history() const { return *history_; }
  void undo();
  void redo();
  void jumpTo(std::size_t step);
  /// The document as it is shown: of a preview while there is one.
  [[nodiscard]] const Document& shown() const;
  [[nodiscard]] bool isPreview() const { return preview_.has_value(); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] QString title() const;
  [[nodiscard]] bool isUnsaved() const;
  /// Writes the whole file, then puts it in place of the old one.
  Result<void> save(const std::filesystem::path& path);

  // ---- pattern
  /// The last pattern that could be made; null before the first. Not of the shown lines while
  /// isPatternCurrent() is false.
  [[nodiscard]] const std::shared_ptr<const Pattern>& pattern() const { return pattern_; }
  [[nodiscard]] bool isPatternCurrent() const { return patternIsCurrent_; }
  [[nodiscard]] bool isPatternPreview() const { return patternIsPreview_; }
  [[nodiscard]] const std::optional<Error>& patternError() const { return patternError_; }
  [[nodiscard]] PatternWorker& worker() { return worker_; }
  /// Of the last full pattern, parallel to its pieces; null before the first.
  [[nodiscard]] const Strains& strains() const { return strains_; }
  /// The full pattern that strains() is of.
  [[nodiscard]] const std::shared_ptr<const Pattern>& fullPattern() const { return fullPattern_; }
  void setStrainLook(const StrainLook& look);
  [[nodiscard]] const StrainLook& strainLook() const { return strainLook_; }
  /// The least that a fabric of the pattern bears of the kind shown; nothing where none says.
  [[nodiscard]] std::optional<double> strainLimit() const;
  void setPieceColours(PieceColours colours);
  [[nodiscard]] PieceColours pieceColours() const { return pieceColours_; }
  void setGhosts(std::vector<Ghost> ghosts);
  [[nodiscard]] const std::vector<Ghost>& ghosts() const { return ghosts_; }
  /// In the cut of fullPattern(); nothing while that is not the pattern of the work.
  [[nodiscard]] std::optional<std::size_t> pieceIndex(const std::string& piece) const;
  /// @param piece that it is about; empty where it is about none
  void openPanel(SidePanel panel, const std::string& piece = {});
  /// Leads the eye to a place of the body.
  void showPlace(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);

  // ---- tools
  void setTool(ToolId id);
  [[nodiscard]] Tool& tool() { return *tool_; }
  [[nodiscard]] const Tool& tool() const { return *tool_; }
  void setScreen(const Screen& screen) { screen_ = screen; }
  void setOptions(const DrawingOptions& options);
  void setUnit(LengthUnit unit);
  [[nodiscard]] LengthUnit unit() const { return unit_; }
  /// An event for the tool; everything that shows tools is told.
  void pointer(PointerAction action, const PointerEvent& event);
  bool key(ToolKey key);
  void setToolSetting(double value);
  void setHover(const Selection& hover);  ///< of the pattern; the body's comes from the tool
  [[nodiscard]] const Selection& hover() const { return hover_; }

  // ---- ToolHost
  [[nodiscard]] const Document& document() const override { return history_->current(); }
  [[nodiscard]] const PlacedLines& lines() const override { return lines_; }
  [[nodiscard]] const Screen& screen() const override { return screen_; }
  [[nodiscard]] const DrawingOptions& options() const override { return options_; }
  [[nodiscard]] const Selection& selection() const override { return selection_; }
  [[nodiscard]] const std::vector<std::vector<Eigen::Vector3d>>& middle() const override {
    return middle_;
  }
  [[nodiscard]] std::optional<std::string> pieceAt(const SurfacePoint& point) const override;
  [[nodiscard]] QString lengthText(double mm) const override;
  void select(const Selection& selection) override;
  void preview(const Document& document, bool withPattern) override;
  void dropPreview() override;
  void commit(const QString& name, const Document& document) override;
  void tell(const QString& sentence) override;

 Q_SIGNALS:
  void workStarted();   ///< another document, maybe another body
  void bodyChanged();   ///< the same work on another body
  void linesChanged();  ///< what is drawn on the body
  void historyChanged();
  void selectionChanged();
  void patternChanged();
  void patternStateChanged();
  void toolChanged();  ///< another tool, or other options
  void toolMoved();    ///< hint, overlay or cursor may be others
  void hoverChanged();
  void strainChanged();
  void coloursChanged();
  void ghostsChanged();
  void panelWanted(toile::studio::SidePanel panel, const std::string& piece);
  void placeWanted(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);
  void told(const QString& sentence);

 private:
  void showDocument(const Document& document);
  void take(const PatternAnswer& answer);
  void afterJump();
  void takeBody();

  std::optional<History> history_;
  std::filesystem::path path_;
  std::filesystem::path origin_;  ///< from where relative names of models count
  std::shared_ptr<const Design> saved_;
  std::optional<Document> preview_;
  PlacedLines lines_;
  std::vector<std::vector<Eigen::Vector3d>> middle_;
  Selection selection_, hover_;
  std::unique_ptr<Tool> tool_;
  DrawingOptions options_;
  LengthUnit unit_ = LengthUnit::Millimetre;
  Screen screen_;

  PatternWorker worker_;
  std::shared_ptr<const Pattern> pattern_;
  std::shared_ptr<const Pattern> fullPattern_;
  Strains strains_;
  StrainLook strainLook_;
  PieceColours pieceColours_ = PieceColours::Fabric;
  std::vector<Ghost> ghosts_;
  std::unique_ptr<PieceFinder> pieces_;  ///< of the last full pattern
  std::vector<std::string> pieceIds_;    ///< of the same
  std::optional<Error> patternError_;
  bool patternIsCurrent_ = false;
  bool patternIsPreview_ = false;
};

}  // namespace toile::studio
