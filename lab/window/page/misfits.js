// Why two ends do not fit, in words.

import { text } from "./words.js";

const values = ({ offered, requested }) => ({ offered: text(offered), requested: text(requested) });

/** All reasons as a sentence. */
export function reasons(list) {
  return list.map((reason) => text(`misfit_${reason.policy}`, values(reason))).join("; ");
}

/** The first reason in two words, for the drawing. */
export function short([{ policy }]) {
  if (policy === "type" || policy === "definition") return text(`short_${policy}`);
  return text("short_qos", { policy: text(`policy_${policy}`) });
}
