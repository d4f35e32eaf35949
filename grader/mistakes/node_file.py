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
    example,
)
from grader.mistakes.fixes import layout
from grader.mistakes.kind import Kind
from grader.package.edit.tree import Chmod, Copy, Crlf, Delete, Move, Replace, Write

PLACE = msg(
    "Python imports the node as the module <package>.<file>, so the file must be in the inner "
    "folder, which has the package's name and contains __init__.py."
)
MOVE = msg(
    "Move it into the inner folder, then build again. In the package's folder, run: mv {there} {wanted}"
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
            "Delete the folder {folder}, or give it another name. Delete the workspace's build/ and "
            "install/ too: they can still have a copy of it. Then build again."
        ),
        fixes={
            "imported": msg(
                "Give the folder {folder} another name, for example {other}, and write this name where "
                "code imports from the folder ({lines}). Delete the workspace's build/ and install/ too: "
                "they can still have a copy of it. Then build again."
            ),
        },
        link=links.FIRST_NODE,
        examples=(
            example(
                "node_hidden_by_folder",
                Write(f"{NODE.removesuffix('.py')}/__init__.py", ""),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "folder_of_the_nodes_name_is_imported",
                Write(f"{NODE.removesuffix('.py')}/__init__.py", ""),
                Write(f"{NODE.removesuffix('.py')}/settings.py", "PERIOD = 1.0\n"),
                Replace(
                    NODE,
                    "from rclpy.node import Node\n",
                    "from rclpy.node import Node\nfrom .my_first_node.settings import PERIOD\n",
                ),
                Replace(NODE, "create_timer(1.0,", "create_timer(PERIOD,"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
        ),
    ),
    Kind(
        id="source.misplaced_node_file",
        stage="file",
        title=msg("The node's file is in another folder"),
        why=PLACE,
        fix=msg("Move it into the inner folder: its path in the package must be {wanted}."),
        fixes={
            "init": msg(
                "Give this file the node's name, and make an empty __init__.py. In the package's "
                "folder, run: mv {init} {wanted} && touch {init}"
            ),
            "init_empty": msg(
                "Move the code from {init} into {wanted}, and leave __init__.py empty."
            ),
            "inside": MOVE,
            "src_layout": msg(
                "Move the whole folder out of src/. In the package's folder, run: mv src/{inner} . && "
                "rmdir src. In setup.py, write packages=find_packages(exclude=['test']), without "
                "where='src' and without package_dir. Then build again."
            ),
            "scripts": msg(
                "Move it into the inner folder, and delete {code} from line {line} of setup.py: there is "
                "no such file then. Then build again. In the package's folder, run: mv {there} {wanted}"
            ),
            "entry": msg(
                "Move it into the inner folder, and let setup.py name it: write {module} instead of "
                "{module_there} there. Then build again. In the package's folder, run: mv {there} "
                "{wanted}"
            ),
            "folder": msg("Rename the folder {folder} to {inner}, to the letter: case matters."),
        },
        whys={
            "entry": msg(
                "The exercise asks for the node in {wanted}. The entry point must name that file."
            )
        },
        link=links.PACKAGE,
        fixed_by=(
            layout.out_of_src,
            layout.inner_folder,
            layout.node_file,
            layout.out_of_init,
        ),
        examples=(
            example(
                "node_among_the_scripts",
                Move(NODE, "scripts/my_first_node.py"),
                Replace(
                    SETUP,
                    "    entry_points={",
                    "    scripts=['scripts/my_first_node.py'],\n    entry_points={",
                ),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_init",
                Delete(INIT),
                Move(NODE, INIT),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_init_and_empty_file",
                Delete(INIT),
                Move(NODE, INIT),
                Write(NODE, b""),
                Chmod(NODE, 0o755),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_init_and_only_comments_in_its_file",
                Delete(INIT),
                Move(NODE, INIT),
                Write(NODE, "#!/usr/bin/env python3\n# My first node\n", 0o755),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "inner_folder_with_capitals",
                Move(INNER, "My_Robot_Controller"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_package_root",
                Move(NODE, "my_first_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "inner_folder_in_src",
                Move(NODE, f"src/{NODE}"),
                Move(INIT, f"src/{INIT}"),
                Replace(SETUP, "find_packages(exclude=['test'])", "find_packages(where='src')"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_in_scripts",
                Move(NODE, "scripts/my_first_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "inner_folder_misnamed",
                Move(INNER, "my_robot_controler"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
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
            example(
                "node_misnamed",
                Move(NODE, "my_robot_controller/my_frist_node.py"),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_misnamed_in_entry_too",
                Move(NODE, f"{INNER}/first_node.py"),
                Replace(SETUP, f"{PACKAGE}.my_first_node:main", f"{PACKAGE}.first_node:main"),
                fails="source.node_file",
                also={"entry_point.mapping": "setup.other_module"},
                note="the node runs: it is read and judged under its own name",
            ),
            example(
                "node_misnamed_without_exec_bit",
                Move(NODE, f"{INNER}/hello.py"),
                Chmod(f"{INNER}/hello.py", 0o644),
                Crlf(f"{INNER}/hello.py"),
                fails="source.node_file",
                also={
                    "source.exec_bit": "source.not_executable",
                    "source.shebang": "source.crlf",
                },
                blocks=UNSTARTED,
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
                "Its name must be exactly __init__.py, with two underscores on both sides. "
                "Rename it, then build again. In the package's folder, run: mv {there} {path}"
            ),
            "ending": msg(
                "An editor or a file manager has added {form} to its name, and may not show this "
                "ending. Rename it, then build again. In the package's folder, run: mv {there} {path}"
            ),
            "blank": msg(
                "There is a blank at the beginning or the end of its name. Rename it, then build "
                "again. In the package's folder, run: mv {there} {path}"
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
            example(
                "init_saved_as_text",
                Move(INIT, f"{INNER}/__init__.py.txt"),
                fails="run.starts",
            ),
            example(
                "init_with_a_blank_at_its_end",
                Move(INIT, f"{INNER}/__init__.py "),
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
                "node_empty_and_the_program_beside_setup",
                Copy(NODE, "my_first_node.py"),
                Write(NODE, b""),
                fails="source.node_file",
                blocks=UNSTARTED,
            ),
            example(
                "node_empty_beside_a_rescue_file",
                Move(NODE, f"{NODE}.save"),
                Write(NODE, b""),
                fails="source.node_file",
                also={"source.exec_bit": "source.not_executable"},
                blocks=UNSTARTED,
            ),
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
