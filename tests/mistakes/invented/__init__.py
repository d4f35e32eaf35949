"""Mistakes of beginners beyond the catalogue and the corpus, and what a teacher would say.

`fails` is the check that must fail. All of it was written before the packages were marked for the
first time; the sets were judged one after the other, the third after the corrections for the
others.
"""

from tests.mistakes.invented.first import FIRST
from tests.mistakes.invented.second import SECOND
from tests.mistakes.invented.third import THIRD

INVENTED = (*FIRST, *SECOND, *THIRD)
