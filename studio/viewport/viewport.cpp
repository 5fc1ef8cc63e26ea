// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewport/viewport.h"

#include <Eigen/Geometry>
#include <QApplication>
#include <QPointer>
#include <QThreadPool>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace toile::studio {

using Eigen::Vector3d;

namespace {

constexpr int kFlight = 180;     // ms
constexpr int kRest = 160;       // ms after which the picture is drawn finely
constexpr double kAround = 160;  // mm that are seen round a place

}  // namespace

Viewport::Viewport(Session& session, QWidget* parent) : GlCanvas(parent), session_(session) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(360, 300);
  setAccessibleName(tr("Body"));
  setObjectName(QStringLiteral("viewport"));
  clock_.start();

  connect(&session, &Session::workStarted, this, &Viewport::bodyChanged);
  connect(&session, &Session::bodyChanged, this, &Viewport::bodyChanged);
  const auto refresh = [this] {
    if (!inHand_) update();
  };
  connect(&session, &Session::linesChanged, this, refresh);
  connect(&session, &Session::selectionChanged, this, [this] { update(); });
  connect(&session, &Session::hoverChanged, this, refresh);
  connect(&session, &Session::toolMoved, this, &Viewport::updateCursor);
  connect(&session, &Session::toolMoved, this, refresh);
  connect(&session, &Session::patternChanged, this, [this] {
    if (session_.isPatternPreview()) return;
    placeLabels();
    strainChanged();
  });
  connect(&session, &Session::strainChanged, this, &Viewport::strainChanged);
  connect(&session, &Session::ghostsChanged, this, [this] { update(); });
  connect(&session, &Session::coloursChanged, this, [this] {
    verticesAreOld_ = true;
    update();
  });
  connect(&session, &Session::placeWanted, this, &Viewport::lookAtPlace);
  rest_.setSingleShot(true);
  rest_.setInterval(kRest);
  connect(&rest_, &QTimer::timeout, this, [this] {
    coarse_ = false;
    update();
  });
  flight_.setDuration(kFlight);
  flight_.setStartValue(0.0);
  flight_.setEndValue(1.0);
  flight_.setEasingCurve(QEasingCurve::OutCubic);
  connect(&flight_, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    setCamera(between(flightFrom_, flightTo_, value.toDouble()));
  });
  if (session.hasWork()) bodyChanged();
}

Viewport::~Viewport() {
  if (!makeCurrent()) return;
  bodyPicture_.reset();
  fineBody_.reset();
  body_ = BodyLayer();
  lines_ = LineLayer();
  doneCurrent();
}

void Viewport::bodyChanged() {
  const auto model = session_.document().model;
  if (!shape_ || shape_->model != model) {
    shape_ = std::make_shared<BodyShape>(makeBodyShape(model));
    const std::uint64_t number = ++shapeNumber_;
    // Folds darken a moment later: what the eye needs first is there at once.
    QPointer<Viewport> self(this);
    QThreadPool::globalInstance()->start([self, shape = *shape_, number] {
      std::vector<float> openness = computeOpenness(shape);
      QMetaObject::invokeMethod(
          qApp,
          [self, openness = std::move(openness), number]() mutable {
            if (!self || self->shapeNumber_ != number) return;
            self->shape_->openness = std::move(openness);
            self->verticesAreOld_ = true;
            self->update();
          },
          Qt::QueuedConnection);
    });
    camera_ = fitted(seenFrom(Camera(), StandardView::Front), model->mesh->boxMin(),
                     model->mesh->boxMax(), double(width()) / std::max(1, height()));
    setCamera(camera_);
  }
  verticesAreOld_ = true;
  update();
}

Screen Viewport::screen() const {
  return {camera_.view(), double(std::max(1, width())), double(std::max(1, height()))};
}

void Viewport::setCamera(const Camera& camera) {
  camera_ = camera;
  session_.setScreen(screen());
  interacted();
  Q_EMIT cameraChanged();
}

void Viewport::interacted() {
  coarse_ = true;
  rest_.start();
  update();
}

void Viewport::lookFrom(const Camera& camera) {
  flight_.stop();
  if (!motion_) return setCamera(camera);
  flightFrom_ = camera_;
  flightTo_ = camera;
  flight_.start();
}

void Viewport::lookFrom(StandardView side) {
  lookFrom(seenFrom(camera_, side));
}

void Viewport::fitAll() {
  const Mesh& mesh = *session_.document().model->mesh;
  lookFrom(fitted(camera_, mesh.boxMin(), mesh.boxMax(), double(width()) / std::max(1, height())));
}

std::vector<Vector3d> Viewport::selectedPoints() const {
  const Selection& selection = session_.selection();
  if (selection.kind == Selection::Kind::Line) {
    const PlacedLine* line = session_.lines().find(selection.id);
    return line == nullptr ? std::vector<Vector3d>() : line->points;
  }
  if (selection.kind == Selection::Kind::Piece && session_.pattern()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      if (piece.id == selection.id) return piece.mesh->positions();
    }
  }
  return {};
}

void Viewport::fitSelection() {
  const std::vector<Vector3d> points = selectedPoints();
  if (points.empty()) return fitAll();
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  lookFrom(fitted(camera_, low, high, double(width()) / std::max(1, height())));
}

void Viewport::lookStraightAtSelection() {
  const Selection& selection = session_.selection();
  Vector3d normal = Vector3d::Zero();
  if (const PlacedLine* line = session_.lines().find(selection.id)) {
    for (const Vector3d& n : line->normals) normal += n;
  } else if (session_.pattern()) {
    for (const Piece& piece : session_.pattern()->cut.pieces) {
      if (piece.id != selection.id) continue;
      for (std::size_t f = 0; f < piece.mesh->faceCount(); ++f) {
        normal += piece.mesh->area(FaceId(f)) * piece.mesh->normal(FaceId(f));
      }
    }
  }
  const std::vector<Vector3d> points = selectedPoints();
  if (points.empty() || normal.norm() < 1e-9) return;
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  lookFrom(
      fitted(lookingAlong(camera_, normal), low, high, double(width()) / std::max(1, height())));
}

void Viewport::strainChanged() {
  const StrainLook& look = session_.strainLook();
  look_.strainScale = look.scale;
  look_.strainOneSided = look.kind == StrainKind::Shear;
  look_.strainLimit = session_.strainLimit().value_or(0);
  verticesAreOld_ = true;
  update();
}

void Viewport::lookAtPlace(const Vector3d& place, const Vector3d& normal) {
  const Vector3d around = Vector3d::Constant(kAround);
  lookFrom(fitted(lookingAlong(camera_, normal), place - around, place + around,
                  double(width()) / std::max(1, height())));
}

void Viewport::setEdges(bool edges) {
  look_.edges = edges;
  update();
}

void Viewport::setLabels(bool labels) {
  labels_ = labels;
  update();
}

void Viewport::setSeeThrough(bool seeThrough) {
  seeThrough_ = seeThrough;
  update();
}

void Viewport::themeChanged() {
  verticesAreOld_ = true;
  update();
}

QString Viewport::viewName() const {
  if (camera_.elevation > 1.2) return tr("from above");
  if (camera_.elevation < -1.2) return tr("from below");
  // Eight directions; the wearer's right is what is seen from azimuth -90 degrees.
  const double turns = camera_.azimuth / (std::numbers::pi / 4);
  switch ((static_cast<int>(std::lround(turns)) + 8) % 8) {
    case 0:
      return std::abs(turns) < 0.06 ? tr("front")
             : turns < 0            ? tr("front, from the right")
                                    : tr("front, from the left");
    case 1:
      return tr("front, from the left");
    case 2:
      return tr("left side");
    case 3:
      return tr("back, from the left");
    case 4:
      return tr("back");
    case 5:
      return tr("back, from the right");
    case 6:
      return tr("right side");
    default:
      return tr("front, from the right");
  }
}

}  // namespace toile::studio
