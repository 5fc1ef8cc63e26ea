// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/tool_setting_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>

#include "app/number_field.h"

namespace toile::studio {

namespace {

constexpr int kSteps = 100;

}  // namespace

ToolSettingBar::ToolSettingBar(Session& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      name_(new QLabel),
      length_(new NumberField(NumberField::Kind::Length, session.unit())),
      slider_(new QSlider(Qt::Horizontal)),
      share_(new NumberField(NumberField::Kind::Share, session.unit())) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 0, 8, 0);
  row->setSpacing(8);
  name_->setObjectName(QStringLiteral("second"));
  length_->setFixedWidth(132);
  length_->setObjectName(QStringLiteral("toolLength"));
  slider_->setRange(0, kSteps);
  slider_->setFixedWidth(120);
  slider_->setFocusPolicy(Qt::StrongFocus);
  share_->setFixedWidth(84);
  share_->setRange(0, 1);
  for (QWidget* widget : {static_cast<QWidget*>(name_), static_cast<QWidget*>(length_),
                          static_cast<QWidget*>(slider_), static_cast<QWidget*>(share_)}) {
    row->addWidget(widget);
  }
  for (const NumberField* field : {length_, share_}) {
    connect(field, &NumberField::valueEntered, this, [this, field](double value) {
      enter(value);
      if (field->hasFocus()) Q_EMIT taken();  // by Enter, not by going elsewhere
    });
  }
  connect(slider_, &QSlider::valueChanged, this,
          [this](int value) { enter(static_cast<double>(value) / kSteps); });
  connect(&session, &Session::toolChanged, this, &ToolSettingBar::refresh);
  connect(&session, &Session::toolMoved, this, &ToolSettingBar::refresh);
  refresh();
}

void ToolSettingBar::enter(double value) {
  if (session_.hasWork()) session_.setToolSetting(value);
}

void ToolSettingBar::refresh() {
  const auto setting = session_.tool().setting();
  // The parts, not the whole: a tool bar shows its widgets as it likes.
  const bool isLength = setting && setting->kind == ToolSetting::Kind::Length;
  const bool isShare = setting && setting->kind == ToolSetting::Kind::Share;
  name_->setVisible(setting.has_value());
  length_->setVisible(isLength);
  slider_->setVisible(isShare);
  share_->setVisible(isShare);
  if (!setting) return;
  name_->setText(setting->name);
  for (QWidget* field : {static_cast<QWidget*>(length_), static_cast<QWidget*>(slider_),
                         static_cast<QWidget*>(share_)}) {
    field->setAccessibleName(setting->name);
  }
  if (isLength) {
    length_->setUnit(session_.unit());
    length_->setValue(setting->value);
    return;
  }
  const QSignalBlocker blocker(slider_);
  slider_->setValue(static_cast<int>(std::lround(setting->value * kSteps)));
  share_->setValue(std::round(setting->value * kSteps) / kSteps);
}

}  // namespace toile::studio
