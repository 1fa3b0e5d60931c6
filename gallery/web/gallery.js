// Comforts; every page is complete without them. A classic script, because browsers refuse modules
// on file://.
(function () {
  'use strict';

  function make(tag, properties, parent) {
    var element = Object.assign(document.createElement(tag), properties);
    parent.appendChild(element);
    return element;
  }

  // A copy button on every command.
  function addCopyButtons() {
    if (!navigator.clipboard) return;
    document.querySelectorAll('pre.command').forEach(function (pre) {
      var text = pre.textContent;
      pre.classList.add('copyable');
      var button = make('button', { type: 'button', className: 'copy', textContent: 'Copy' }, pre);
      button.addEventListener('click', function () {
        navigator.clipboard.writeText(text).then(
          function () { button.textContent = 'Copied'; },
          function () { button.textContent = 'Select and copy by hand'; });
      });
    });
  }

  // Enlarged pictures scroll together, so that one always sees the same pixels in all of them.
  function linkScrolling() {
    var frames = Array.from(document.querySelectorAll('.picture'));
    frames.forEach(function (frame) {
      frame.addEventListener('scroll', function () {
        frames.forEach(function (other) {
          if (other === frame) return;
          if (other.scrollLeft !== frame.scrollLeft) other.scrollLeft = frame.scrollLeft;
          if (other.scrollTop !== frame.scrollTop) other.scrollTop = frame.scrollTop;
        });
      });
    });
  }

  // Filter of the grid by text and by status; what does not match fades, empty rows go.
  function addFilter() {
    var cells = Array.from(document.querySelectorAll('td[data-status]'));
    var first = document.querySelector('.grid-section');
    if (!first || cells.length < 2) return;
    var form = document.createElement('form');
    form.className = 'filter';
    form.addEventListener('submit', function (event) { event.preventDefault(); });
    first.parentNode.insertBefore(form, first);
    var textLabel = make('label', { textContent: 'Find ' }, form);
    var text = make('input', { type: 'search', placeholder: 'blinn 128' }, textLabel);
    var statusLabel = make('label', { textContent: 'Status ' }, form);
    var status = make('select', {}, statusLabel);
    make('option', { value: '', textContent: 'any' }, status);
    new Set(cells.map(function (cell) { return cell.dataset.status; })).forEach(function (name) {
      make('option', { value: name, textContent: name === 'missing' ? 'not done' : name }, status);
    });
    var count = make('output', {}, form);

    function apply() {
      var words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
      var shown = 0;
      cells.forEach(function (cell) {
        var haystack = cell.dataset.text.toLowerCase();
        var match = (!status.value || cell.dataset.status === status.value) &&
          words.every(function (word) { return haystack.includes(word); });
        cell.classList.toggle('filtered', !match);
        if (match) shown += 1;
      });
      document.querySelectorAll('table.grid tbody tr').forEach(function (row) {
        row.hidden = !row.querySelector('td[data-status]:not(.filtered)');
      });
      count.textContent = 'showing ' + shown + ' of ' + cells.length;
    }
    text.addEventListener('input', apply);
    status.addEventListener('change', apply);
    apply();
  }

  addCopyButtons();
  linkScrolling();
  addFilter();
}());
