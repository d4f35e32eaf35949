// The terminal and the editor style themselves; the page's policy allows that with its nonce only.

export const nonce = document.querySelector("link[nonce]").nonce;

const create = Document.prototype.createElement;
Document.prototype.createElement = function (name, ...rest) {
  const element = create.call(this, name, ...rest);
  if (element instanceof HTMLStyleElement) element.nonce = nonce;
  return element;
};
