"""What Moodle calls the columns of its grading worksheet in other languages.

From Moodle's language packs: `recordid`, `hiddenuser` and `maxgrade` of mod_assign, `grade` of the
core, the name of assignfeedback_comments. A worksheet in a language that is not here is understood
by its content, or its columns are named by the caller.
"""

from __future__ import annotations

import re

GRADE = frozenset(
    {
        "grade",
        "bewertung",
        "note",
        "calificación",
        "puntuación",
        "nota",
        "avaliação",
        "qualificació",
        "cualificación",
        "kalifikazioa",
        "valutazione",
        "voto",
        "cijfer",
        "beoordeling",
        "betyg",
        "karakter",
        "vurdering",
        "einkunn",
        "arvosana",
        "arviointi",
        "ocena",
        "známka",
        "hodnocení",
        "hodnotenie",
        "osztályzat",
        "értékelés",
        "pontszám",
        "notă",
        "оцена",
        "оценка",
        "оцінка",
        "βαθμός",
        "not",
        "puan",
        "hinne",
        "įvertinimas",
        "vērtējums",
        "nilai",
        "điểm",
        "成绩",
        "评分",
        "成績",
        "評分",
        "分數",
        "評点",
        "評定",
        "성적",
        "평점",
        "점수",
        "الدرجة",
        "ציון",
        "نمره",
        "คะแนน",
        "ग्रेड",
    }
)
FEEDBACK = frozenset(
    {
        "feedback comments",
        "feedback als kommentar",
        "feedback comment",
        "commentaires de feedback",
        "feedback par commentaires",
        "comentarios de retroalimentación",
        "comentarios de la retroalimentación",
        "comentaris de retroacció",
        "comentários de feedback",
        "comentários",
        "commenti",
        "feedback reacties",
        "feedbackkommentarer",
        "återkoppling, kommentarer",
        "palautekommentit",
        "komentarz zwrotny",
        "отзыв в виде комментария",
        "反馈评语",
        "反馈意见",
        "回饋評語",
        "フィードバックコメント",
        "피드백 의견",
    }
)
IDENTIFIER = frozenset(
    {
        "identifier",
        "id",
        "identifikator",
        "id-nummer",
        "teilnehmer-id",
        "identifiant",
        "identificador",
        "identificativo",
        "identificatie",
        "identifikační číslo",
        "identyfikator",
        "идентификатор",
        "标识符",
        "識別碼",
        "識別子",
    }
)
MAXIMUM = re.compile(r"max|máx|massim|maks|höchst|högst|enimm|najv|макс|最高|最大|최대|最大|أقصى")
