// SPDX-License-Identifier: Apache-2.0
#pragma once

// Lessons: prompts; the instructor's window, with its actions in the order of InstructorAction; the parts of the curve,
// and the shapes in the same order; items and answers of the questionnaires, one run each.
#define AFM_FOR_EACH_LESSON_PHRASE(PHRASE)                                        \
  PHRASE(KeySkip, "key-skip", "", kLine)                                          \
  PHRASE(KeyTryAgain, "key-try-again", "", kLine)                                 \
  PHRASE(LessonConsent, "lesson-consent", "", kParagraph)                         \
  PHRASE(LessonConsentYes, "lesson-consent-yes", "", kLine)                       \
  PHRASE(LessonConsentNo, "lesson-consent-no", "", kLine)                         \
  PHRASE(LessonBreak, "lesson-break", "", kParagraph)                             \
  PHRASE(LessonGoOn, "lesson-go-on", "", kLine)                                   \
  PHRASE(LessonStop, "lesson-stop", "", kLine)                                    \
  PHRASE(LessonStopped, "lesson-stopped", "", kParagraph)                         \
  PHRASE(LessonFinished, "lesson-finished", "", kParagraph)                       \
  PHRASE(LessonStep, "lesson-step", "number count", kLine)                        \
  PHRASE(LessonTrial, "lesson-trial", "number count", kLine)                      \
  PHRASE(LessonPractice, "lesson-practice", "number count", kLine)                \
  PHRASE(LessonQuestion, "lesson-question", "number count", kLine)                \
  PHRASE(LessonPressEnter, "lesson-press-enter", "", kLine)                       \
  PHRASE(LessonPressNumber, "lesson-press-number", "", kLine)                     \
  PHRASE(LessonPressScale, "lesson-press-scale", "", kLine)                       \
  PHRASE(LessonWhich, "lesson-which", "", kLine)                                  \
  PHRASE(LessonState, "lesson-state", "", kLine)                                  \
  PHRASE(LessonStronger, "lesson-stronger", "", kLine)                            \
  PHRASE(LessonFirst, "lesson-first", "", kLine)                                  \
  PHRASE(LessonSecond, "lesson-second", "", kLine)                                \
  PHRASE(LessonAnswerFirst, "lesson-answer-first", "", kLine)                     \
  PHRASE(LessonAnswerSecond, "lesson-answer-second", "", kLine)                   \
  PHRASE(LessonForceWasOff, "lesson-force-was-off", "", kParagraph)               \
  PHRASE(LessonForceWasWeak, "lesson-force-was-weak", "", kParagraph)             \
  PHRASE(LessonForceWasOn, "lesson-force-was-on", "", kParagraph)                 \
  PHRASE(LessonLineWas, "lesson-line-was", "distance", kLine)                     \
  PHRASE(LessonThresholdWas, "lesson-threshold-was", "share", kLine)              \
  PHRASE(LessonPushWasOff, "lesson-push-was-off", "", kParagraph)                 \
  PHRASE(LessonPushWasWeak, "lesson-push-was-weak", "", kParagraph)               \
  PHRASE(LessonWritingWasOff, "lesson-writing-was-off", "", kParagraph)           \
  PHRASE(LessonWritingWasWeak, "lesson-writing-was-weak", "", kParagraph)         \
  PHRASE(LessonMarksOutside, "lesson-marks-outside", "distance", kParagraph)      \
  PHRASE(LessonTooNarrow, "lesson-too-narrow", "width wanted", kParagraph)        \
  PHRASE(LessonTooWide, "lesson-too-wide", "width wanted", kParagraph)            \
  PHRASE(LessonInkTooNarrow, "lesson-ink-too-narrow", "width wanted", kParagraph) \
  PHRASE(LessonInkTooWide, "lesson-ink-too-wide", "width wanted", kParagraph)     \
  PHRASE(LessonLinesLeft, "lesson-lines-left", "share", kParagraph)               \
  PHRASE(LessonRight, "lesson-right", "", kLine)                                  \
  PHRASE(LessonWrong, "lesson-wrong", "answer", kLine)                            \
  PHRASE(InstructorTitle, "instructor-title", "lesson", kLine)                    \
  PHRASE(InstructorNext, "instructor-next", "", kLine)                            \
  PHRASE(InstructorSkip, "instructor-skip", "", kLine)                            \
  PHRASE(InstructorStop, "instructor-stop", "", kLine)                            \
  PHRASE(InstructorHandOff, "instructor-hand-off", "", kLine)                     \
  PHRASE(InstructorReallyStop, "instructor-really-stop", "", kLine)               \
  PHRASE(InstructorHandOn, "instructor-hand-on", "", kLine)                       \
  PHRASE(InstructorParticipant, "instructor-participant", "", kLine)              \
  PHRASE(InstructorNobody, "instructor-nobody", "", kLine)                        \
  PHRASE(InstructorWaits, "instructor-waits", "", kLine)                          \
  PHRASE(InstructorWaitsGoOn, "instructor-waits-go-on", "", kLine)                \
  PHRASE(InstructorWaitsCycle, "instructor-waits-cycle", "", kLine)               \
  PHRASE(InstructorWaitsPush, "instructor-waits-push", "", kLine)                 \
  PHRASE(InstructorWaitsWrite, "instructor-waits-write", "", kLine)               \
  PHRASE(InstructorWaitsAnswer, "instructor-waits-answer", "", kLine)             \
  PHRASE(InstructorWaitsNothing, "instructor-waits-nothing", "", kLine)           \
  PHRASE(InstructorForce, "instructor-force", "", kLine)                          \
  PHRASE(InstructorForceKeptOff, "instructor-force-kept-off", "", kLine)          \
  PHRASE(InstructorTime, "instructor-time", "", kLine)                            \
  PHRASE(InstructorMinutes, "instructor-minutes", "elapsed planned", kLine)       \
  PHRASE(InstructorRight, "instructor-right", "", kLine)                          \
  PHRASE(InstructorShare, "instructor-share", "right count", kLine)               \
  PHRASE(DrawPart1, "draw-part-1", "", kParagraph)                                \
  PHRASE(DrawPart2, "draw-part-2", "", kParagraph)                                \
  PHRASE(DrawPart3, "draw-part-3", "", kParagraph)                                \
  PHRASE(DrawPart4, "draw-part-4", "", kParagraph)                                \
  PHRASE(DrawPart5, "draw-part-5", "", kParagraph)                                \
  PHRASE(DrawShape1, "draw-shape-1", "", kLine)                                   \
  PHRASE(DrawShape2, "draw-shape-2", "", kLine)                                   \
  PHRASE(DrawShape3, "draw-shape-3", "", kLine)                                   \
  PHRASE(DrawShape4, "draw-shape-4", "", kLine)                                   \
  PHRASE(DrawShape5, "draw-shape-5", "", kLine)                                   \
  PHRASE(Paper1, "paper-1", "", kParagraph)                                       \
  PHRASE(Paper2, "paper-2", "", kParagraph)                                       \
  PHRASE(Paper3, "paper-3", "", kParagraph)                                       \
  PHRASE(Paper4, "paper-4", "", kParagraph)                                       \
  PHRASE(Paper5, "paper-5", "", kParagraph)                                       \
  PHRASE(Paper6, "paper-6", "", kParagraph)                                       \
  PHRASE(Paper7, "paper-7", "", kParagraph)                                       \
  PHRASE(Paper8, "paper-8", "", kParagraph)                                       \
  PHRASE(Sus1, "sus-1", "", kParagraph)                                           \
  PHRASE(Sus2, "sus-2", "", kParagraph)                                           \
  PHRASE(Sus3, "sus-3", "", kParagraph)                                           \
  PHRASE(Sus4, "sus-4", "", kParagraph)                                           \
  PHRASE(Sus5, "sus-5", "", kParagraph)                                           \
  PHRASE(Sus6, "sus-6", "", kParagraph)                                           \
  PHRASE(Sus7, "sus-7", "", kParagraph)                                           \
  PHRASE(Sus8, "sus-8", "", kParagraph)                                           \
  PHRASE(Sus9, "sus-9", "", kParagraph)                                           \
  PHRASE(Sus10, "sus-10", "", kParagraph)                                         \
  PHRASE(Tlx1, "tlx-1", "", kParagraph)                                           \
  PHRASE(Tlx2, "tlx-2", "", kParagraph)                                           \
  PHRASE(Tlx3, "tlx-3", "", kParagraph)                                           \
  PHRASE(Tlx4, "tlx-4", "", kParagraph)                                           \
  PHRASE(Tlx5, "tlx-5", "", kParagraph)                                           \
  PHRASE(Tlx6, "tlx-6", "", kParagraph)                                           \
  PHRASE(Ssq1, "ssq-1", "", kParagraph)                                           \
  PHRASE(Ssq2, "ssq-2", "", kParagraph)                                           \
  PHRASE(Ssq3, "ssq-3", "", kParagraph)                                           \
  PHRASE(Ssq4, "ssq-4", "", kParagraph)                                           \
  PHRASE(Ssq5, "ssq-5", "", kParagraph)                                           \
  PHRASE(Ssq6, "ssq-6", "", kParagraph)                                           \
  PHRASE(Ssq7, "ssq-7", "", kParagraph)                                           \
  PHRASE(Ssq8, "ssq-8", "", kParagraph)                                           \
  PHRASE(Ssq9, "ssq-9", "", kParagraph)                                           \
  PHRASE(Ssq10, "ssq-10", "", kParagraph)                                         \
  PHRASE(Ssq11, "ssq-11", "", kParagraph)                                         \
  PHRASE(Ssq12, "ssq-12", "", kParagraph)                                         \
  PHRASE(Ssq13, "ssq-13", "", kParagraph)                                         \
  PHRASE(Ssq14, "ssq-14", "", kParagraph)                                         \
  PHRASE(Ssq15, "ssq-15", "", kParagraph)                                         \
  PHRASE(Ssq16, "ssq-16", "", kParagraph)                                         \
  PHRASE(PaperAnswer0, "paper-answer-0", "", kLine)                               \
  PHRASE(PaperAnswer1, "paper-answer-1", "", kLine)                               \
  PHRASE(PaperAnswer2, "paper-answer-2", "", kLine)                               \
  PHRASE(PaperAnswer3, "paper-answer-3", "", kLine)                               \
  PHRASE(PaperAnswer4, "paper-answer-4", "", kLine)                               \
  PHRASE(SusAnswer1, "sus-answer-1", "", kLine)                                   \
  PHRASE(SusAnswer2, "sus-answer-2", "", kLine)                                   \
  PHRASE(SusAnswer3, "sus-answer-3", "", kLine)                                   \
  PHRASE(SusAnswer4, "sus-answer-4", "", kLine)                                   \
  PHRASE(SusAnswer5, "sus-answer-5", "", kLine)                                   \
  PHRASE(TlxLow, "tlx-low", "", kLine)                                            \
  PHRASE(TlxHigh, "tlx-high", "", kLine)                                          \
  PHRASE(SsqAnswer0, "ssq-answer-0", "", kLine)                                   \
  PHRASE(SsqAnswer1, "ssq-answer-1", "", kLine)                                   \
  PHRASE(SsqAnswer2, "ssq-answer-2", "", kLine)                                   \
  PHRASE(SsqAnswer3, "ssq-answer-3", "", kLine)
