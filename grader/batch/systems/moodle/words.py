"""The names of the columns and states in Moodle's grading worksheet, in many languages.

From Moodle's language packs: `recordid`, `hiddenuser`, `maxgrade`, `status`, `submissionteam`,
`lastmodifiedsubmission` and `submissionstatus_…` of mod_assign, `grade` of the core, the name of
assignfeedback_comments. A worksheet in another language is recognised by its content, or the caller
names its columns.
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
        "피드백 코멘트",
        "피드백 댓글",
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
        "식별자",
    }
)
STATUS = frozenset(
    {
        *("status", "submission status", "statut", "état", "estado", "estatus", "stato", "estat"),
        *(
            "egoera",
            "durum",
            "статус",
            "состояние",
            "状态",
            "狀態",
            "ステータス",
            "상태",
            "제출 상태",
        ),
    }
)
TEAM = frozenset(
    {
        *("group", "groups", "team", "gruppe", "gruppen", "groupe", "grupo", "gruppo", "groep"),
        *("grupp", "grup", "taldea", "ryhmä", "grupa", "skupina", "csoport", "группа", "группы"),
        *("群组", "小组", "群組", "グループ", "모둠", "그룹", "조", "팀"),
    }
)
SUBMITTED_ON = frozenset(
    {
        *(
            "last modified (submission)",
            "zuletzt geändert (abgabe)",
            "dernière modification (remise)",
        ),
        *("última modificación (entrega)", "마지막 수정됨(제출)", "마지막 수정됨 (제출)"),
        *("최종 수정(제출)", "최종 수정 (제출)", "마지막 수정 (제출)", "마지막 수정(제출)"),
    }
)
# the beginning of the status; lateness and `Graded` follow
SUBMITTED = (
    *("submitted", "채점을 위해 제출", "제출 완료", "제출됨", "제출함", "zur bewertung abgegeben"),
    *("remis pour évaluation", "enviado para", "entregado para", "submetido para"),
    *(
        "consegnato per",
        "opdracht ingestuurd",
        "inlämnad för",
        "s'ha tramès",
        "kalifikatzeko bidali",
    ),
    *("notlandırılması için gönderildi", "отправлено для оценивания", "已经提交", "已提交"),
    *("已經繳交", "評定のため"),
)
NOT_SUBMITTED = (
    *("no submission", "draft", "제출이 없습니다", "제출 없음", "제출물 없음", "제출되지 않음"),
    *(
        "제출 안",
        "미제출",
        "아직 제출되지",
        "초안",
        "새 제출",
        "keine abgabe",
        "neue abgabe",
        "entwurf",
    ),
    *("aucune remise", "brouillon", "sin entrega", "sin envío", "no entregado", "borrador"),
    *("nenhum", "sem submissão", "rascunho", "нет ответа", "ответ не представлен", "черновик"),
    *("未提交", "草稿", "尚未繳交", "提出なし", "下書き"),
)
MAXIMUM = re.compile(r"max|máx|massim|maks|höchst|högst|enimm|najv|макс|最高|最大|최대|最大|أقصى")


def says_submitted(status: str, submitted_on: str) -> bool:
    """Return whether Moodle has a submission, by its status, or else by the time of submission.

    In an unknown language only the time decides; Moodle writes `-` for none.
    """
    begin = status.casefold().strip()
    if begin.startswith(SUBMITTED):
        return True
    return not begin.startswith(NOT_SUBMITTED) and submitted_on.strip() not in ("", "-")
