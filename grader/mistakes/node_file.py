"""The catalogue: the node's file: its place and its name."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.example import (
    INIT,
    INNER,
    NO_FILE,
    NODE,
    PACKAGE,
    SETUP,
    UNINSTALLED,
    UNSTARTED,
    Example,
    example,
)
from grader.mistakes.fixes import layout
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Delete, Edit, Move, Replace, Write

PLACE = msg(
    "Python imports the node as the module <package>.<file>, so the file must be in the inner "
    "folder, which has the package's name and contains __init__.py."
)
OWN_COPIES = msg(
    "A build copies your files into build and install. Only the files in src are yours: each build "
    "overwrites the copies."
)
NOTEBOOK = msg(
    "Copy the code of the notebook's cells, without lines that begin with ! or %, into the file "
    "{path}. Write #!/usr/bin/env python3 as its first line, and make the file executable: chmod +x "
    "{path}"
)
BUILT = msg("Copy your code from {copy} into {path}, and edit only that file from now on.")


def _example(name: str, *edits: Edit) -> Example:
    return example(name, *edits, fails="source.node_file", blocks=UNSTARTED)


KINDS = (
    Kind(
        id="source.no_node_file",
        stage="file",
        title=msg("The node's file is missing"),
        why=PLACE,
        fix=msg("Create the file {path} and write the node in it."),
        whys={
            "several": msg(
                "Each of these files has a node: {files}. Which of them is to be marked is not certain."
            )
        },
        fixes={
            "built": BUILT,
            "several": msg("Keep the one that is to be marked, and give it the path {path} (mv)."),
            "notebook": NOTEBOOK,
        },
        link=links.FIRST_NODE,
        fixed_by=(
            layout.node_file,
            layout.node_name,
            layout.out_of_notebook,
        ),
        examples=(
            example(
                "as_created",
                Delete(NODE),
                Replace(
                    SETUP, "            'test_node = my_robot_controller.my_first_node:main',\n", ""
                ),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.no_entry"},
                blocks=(*NO_FILE, *UNINSTALLED),
                note="only ros2 pkg create and a build",
            ),
            example(
                "node_not_written",
                Delete(NODE),
                fails="source.node_file",
                blocks=(*NO_FILE, *UNSTARTED),
                note="the entry point exists, its file does not",
            ),
        ),
    ),
    Kind(
        id="source.hidden_by_folder",
        stage="file",
        title=msg("A folder hides the node's file"),
        why=msg(
            "A folder with an __init__.py is a package. Of a package and a file of the same name, "
            "Python imports the package."
        ),
        fix=msg(
            "Give the folder {folder} another name, also where code imports from it, or delete it. Delete "
            "the workspace's build/ and install/ too: they can still have a copy of it. Then build again."
        ),
        link=links.FIRST_NODE,
        examples=(
            _example("node_hidden_by_folder", Write(f"{NODE.removesuffix('.py')}/__init__.py", "")),
        ),
    ),
    Kind(
        id="source.misplaced_node_file",
        stage="file",
        title=msg("The node's file is in another folder"),
        why=PLACE,
        fix=msg(
            "Move it, so that its path in the package is {wanted}. If setup.py names its old place, correct "
            "that too. Then build again."
        ),
        fixes={
            "init": msg(
                "Give this file the node's name, and make an empty __init__.py. In the package's "
                "folder, run: mv {init} {wanted} && touch {init}"
            ),
            "inside": msg(
                "Move it into the inner folder. In the package's folder, run: mv {there} {wanted}. If "
                "setup.py names its old place (in entry_points, scripts= or where=), correct that too. Then "
                "build again."
            ),
            "folder": msg("Rename the folder {folder} to {inner}, to the letter: case matters."),
        },
        link=links.PACKAGE,
        fixed_by=(layout.inner_folder, layout.node_file, layout.out_of_init),
        examples=(
            _example("node_in_init", Delete(INIT), Move(NODE, INIT)),
            _example("inner_folder_with_capitals", Move(INNER, "My_Robot_Controller")),
            _example("node_in_package_root", Move(NODE, "my_first_node.py")),
            _example("node_in_scripts", Move(NODE, "scripts/my_first_node.py")),
        ),
    ),
    Kind(
        id="source.misnamed_node_file",
        stage="file",
        title=msg("The node's file has a different name"),
        why=msg(
            "The exercise asks for a file of this name. Every letter counts, and case matters."
        ),
        fix=msg("Rename it, then build again. In the package's folder, run: mv {there} {path}"),
        link=links.FIRST_NODE,
        fixed_by=(layout.node_name,),
        examples=(
            _example("node_misnamed", Move(NODE, "my_robot_controller/my_frist_node.py")),
            example(
                "node_misnamed_in_entry_too",
                Move(NODE, f"{INNER}/first_node.py"),
                Replace(SETUP, f"{PACKAGE}.my_first_node:main", f"{PACKAGE}.first_node:main"),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.other_module"},
                note="the node runs: it is read and judged under its own name",
            ),
        ),
    ),
    Kind(
        id="source.node_file_is_link",
        stage="file",
        title=msg("The node's file is a link that leads out of the package"),
        why=msg("The submission contains the link, but not the file that it leads to."),
        fix=msg("Replace the link with the file itself."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.no_init_file",
        stage="file",
        title=msg("The inner folder has no __init__.py"),
        why=msg(
            "find_packages() in setup.py recognises a Python package by its __init__.py. "
            "Without it, nothing in the folder is installed."
        ),
        fix=msg(
            "Create the empty file, then build again. In the package's folder, run: touch {path}"
        ),
        fixes={
            "misnamed": msg(
                "Its name must be exactly __init__.py, with two underscores on both sides, without a blank "
                "or an ending. Rename it, then build again. In the package's folder, run: mv {there} {path}"
            ),
            "folder": msg(
                "{path} is a folder. It must be a file, which may be empty. In the package's folder, "
                "run: rmdir {path} && touch {path}. Then build again."
            ),
        },
        link=links.PACKAGE,
        fixed_by=(layout.init_file,),
        examples=(
            example(
                "init_missing",
                Delete(INIT),
                fails="run.starts",
                note="find_packages finds nothing; builds, then fails with ModuleNotFoundError",
            ),
            example(
                "init_with_single_underscores",
                Move(INIT, f"{INNER}/_init_.py"),
                fails="run.starts",
            ),
        ),
    ),
    Kind(
        id="source.unreadable_node_file",
        stage="file",
        title=msg("The node's file cannot be read"),
        why=msg("A file that cannot be read can be neither marked nor run."),
        fix=msg("Hand in a readable file of ordinary size with your code in it."),
        link=links.FIRST_NODE,
    ),
    Kind(
        id="source.empty_node_file",
        stage="file",
        title=msg("The node's file is empty"),
        why=msg("What you type in the editor is in the file only after you save it."),
        fix=msg("Save the file in your editor (Ctrl+S), then look at it with: cat {path}"),
        whys={
            "built": OWN_COPIES,
            **dict.fromkeys(
                ("beside", "notebook"),
                msg("The exercise asks for the node in {path}. That file is empty."),
            ),
        },
        fixes={
            "built": BUILT,
            "beside": msg(
                "Copy your node into the empty file, and delete the other one. In the package's "
                "folder, run: cp {there} {path} && rm {there}. Then build again."
            ),
            "notebook": NOTEBOOK,
        },
        link=links.FIRST_NODE,
        fixed_by=(layout.node_beside, layout.out_of_notebook),
        examples=(
            example(
                "node_empty",
                Write(NODE, b""),
                fails="source.node_file",
                also={"source.shebang": "source.no_shebang"},
                blocks=UNSTARTED,
                note="not saved in VS Code",
            ),
        ),
    ),
)
